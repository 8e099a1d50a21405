#pragma once
/// The nesting gates, with the binding or without it: without, every one must fail.
#include "data/assessment/gate_report.h"

namespace ostium::app::gates {

/// Each result stands for itself; `quick` takes fewer cases.
/// The first of them alone.
data::GateResult nesting_pair();
std::vector<data::GateResult> nesting_with(bool quick, bool bound);

}  // namespace ostium::app::gates
