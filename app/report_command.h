#pragma once
#include <memory>
#include <string>
#include <vector>

namespace ostium {

struct ReportOptions {
  std::vector<std::string> files;        ///< recordings
  std::string page = "report.html";      ///< empty: none
  std::string csv, events;               ///< empty: none
  std::string questionnaire;             ///< empty: none
  std::string scoring = "pci-elective";  ///< a list of data/scoring, or a file
  std::vector<std::string> codes;        ///< one a recording; else run 1, run 2, ...
  bool pictures = true;
};

struct Vessel;
/// Of DIR/run.h5: report.html, events.csv and key-frames/ beside it. `vessel`: the run's.
void report_folder(const std::string& folder, std::shared_ptr<const Vessel> vessel);
/// `ostium report`. Throws LoadError.
int report_command(const ReportOptions& options);

}  // namespace ostium
