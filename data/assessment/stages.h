#pragma once
/// Stages by which runs are compared: what happened in all of them, in the same order. Nothing is needed of the script,
/// so that a person's run is compared with the expert's.
#include <string>
#include <vector>

#include "data/assessment/page.h"

namespace ostium::data {

struct Stage {
  std::string name;             ///< what begins it: "wire in", "inflation begins"
  std::vector<double> begin_s;  ///< in each of the runs
};

/// The first begins with each run. Instruments in and out, heparin, inflations, stents and covered stents mark the
/// others: those of the first run that come in all, one after another (longest common subsequence, one run after the
/// other). `runs`: at least one.
std::vector<Stage> common_stages(const std::vector<ReportRun>& runs);

}  // namespace ostium::data
