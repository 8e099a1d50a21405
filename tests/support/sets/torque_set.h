#pragma once
/// Wires turned in paths, by relaxation of many nodes, each in turn, in small steps of the drive.
#include "tests/support/one_wire.h"
#include "tests/support/sets/bench_set.h"

namespace ostium::synthetic {

BenchKind torque_kind();
/// A clean set of this wire.
BenchSet torque_of(const BenchWire& wire, unsigned seed);

}  // namespace ostium::synthetic
