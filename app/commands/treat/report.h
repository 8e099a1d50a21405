#pragma once
/// The result of a treatment, as JSON and as a table.
#include <nlohmann/json_fwd.hpp>

#include "app/angiography/textbook_treatment.h"

namespace ostium::app {

nlohmann::ordered_json to_json(const InflationRecord& record);
nlohmann::ordered_json to_json(const StentNumbers& stent);
/// The injuries present.
nlohmann::ordered_json to_json(const vascular::InjuryState& state, const vascular::FlowTree& tree);
void print_treatment(const nlohmann::ordered_json& report);

}  // namespace ostium::app
