#pragma once
/// The nesting gates with or without nesting contact: without it every one must fail.
#include "data/assessment/gate_report.h"

namespace ostium::app::gates {

/// The first result alone. Each result is independent; `quick` runs fewer cases.
data::GateResult nesting_pair();
std::vector<data::GateResult> nesting_with(bool quick, bool bound);

}  // namespace ostium::app::gates
