#pragma once
/// What a treatment came to, as JSON and as a table of it.
#include <nlohmann/json_fwd.hpp>

#include "app/angiography/angioplasty.h"

namespace ostium {

nlohmann::ordered_json to_json(const InflationRecord& record);
nlohmann::ordered_json to_json(const StentNumbers& stent);
/// Those that there are.
nlohmann::ordered_json to_json(const InjuryState& state, const FlowTree& tree);
void print_treatment(const nlohmann::ordered_json& report);

}  // namespace ostium
