#pragma once
/// Wires turned in paths, by relaxation of many nodes, each in turn, in small steps of the drive.
#include "tests/support/bench_set.h"

namespace ostium::synthetic {

BenchKind torque_kind();

}  // namespace ostium::synthetic
