#pragma once
/// Allocations by operator new of this program so far, counted in allocations.cpp.
long allocations();
