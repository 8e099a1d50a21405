#pragma once
/// The result of a run, as text and as JSON.
#include <nlohmann/json_fwd.hpp>

#include "app/session/device/box_run.h"
#include "app/session/run/play.h"

namespace ostium::app {

/// `file`: path of the recording; may be empty.
nlohmann::ordered_json to_json(const RunSetup& setup, const ScriptedRun& run, const PlayReport& report,
                               const std::string& file);
nlohmann::ordered_json to_json(const BoxDriver& hand);

void print_report(const ScriptedRun& run, const PlayReport& report, const std::string& file);
void print_report(const BoxDriver& hand);

}  // namespace ostium::app
