#pragma once
/// Read before each command's source where many are compiled as one (CMAKE_UNITY_BUILD). Each has its own Arguments and
/// its own declare, which are named after their source there: OSTIUM_SOURCE, of which CMake makes a name.
#include "app/command_line/command.h"

#define OSTIUM_JOINED(name, source) name##_of_##source
#define OSTIUM_NAMED_AFTER(name, source) OSTIUM_JOINED(name, source)
#define Arguments OSTIUM_NAMED_AFTER(Arguments, OSTIUM_SOURCE)
#define declare OSTIUM_NAMED_AFTER(declare, OSTIUM_SOURCE)
