#pragma once
/// Number of this program's allocations by operator new so far, counted in allocations.cpp.
long allocations();
