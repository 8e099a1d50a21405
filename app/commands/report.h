#pragma once
#include <memory>
#include <string>

namespace ostium::app {

struct Vessel;
/// Reads DIR/run.h5 and writes report.html, events.csv and key-frames/ beside it. `vessel`: the run's vessel.
void report_folder(const std::string& folder, std::shared_ptr<const Vessel> vessel);

}  // namespace ostium::app
