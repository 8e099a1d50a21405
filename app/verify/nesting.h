#pragma once
/// The nesting gates, with the binding or without it: without, every one must fail.
#include "data/gate_report.h"

namespace ostium::verify {

std::vector<GateResult> nesting_with(bool quick, bool bound);

}  // namespace ostium::verify
