#pragma once
/// Three-point bending by integration along the wire, from a roller to the middle, for sections with any law.
#include "tests/support/bench_set.h"

namespace ostium::synthetic {

BenchKind bend_kind();

}  // namespace ostium::synthetic
