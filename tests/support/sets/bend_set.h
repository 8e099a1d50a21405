#pragma once
/// Three-point bending by integration along the wire, from a roller to the middle, for sections with any law.
#include "tests/support/one_wire.h"
#include "tests/support/sets/bench_set.h"

namespace ostium::synthetic {

BenchKind bend_kind();
/// A clean set of this wire.
BenchSet bend_of(const BenchWire& wire, unsigned seed);

}  // namespace ostium::synthetic
