#pragma once
/// The nesting gates, with the binding or without it: without, every one must fail.
#include "data/assessment/gate_report.h"

namespace ostium::verify {

/// Each result stands for itself; `quick` takes fewer cases.
/// The first of them alone.
GateResult nesting_pair();
std::vector<GateResult> nesting_with(bool quick, bool bound);

}  // namespace ostium::verify
