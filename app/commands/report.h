#pragma once
#include <memory>
#include <string>

namespace ostium::app {

struct Vessel;
/// Reads a recording in the folder and writes report.html, events.csv and key-frames/ beside it. `vessel`: the run's
/// vessel.
void report_folder(const std::string& folder, std::shared_ptr<const Vessel> vessel,
                   const std::string& recording = "run.h5", const std::string& scoring = "pci-elective");

}  // namespace ostium::app
