#pragma once
/// What the steps of a whole procedure cost, from its recording: replayed bit for bit, so that a step's time is the
/// least of several and its counts are the same on every machine.
#include <string>
#include <vector>

#include "core/model/report.h"
#include "tests/bench/rows.h"

namespace ostium::bench {

/// Of every step of a recording.
struct StepCosts {
  struct Step {
    float ms = 0;                  ///< CPU time, the least of the replays
    std::vector<float> phases_ms;  ///< in that replay
    core::StepCounts counts;
    float deepest_mm = 0;  ///< in a wall
    std::uint32_t trouble = 0;
  };
  std::vector<Step> steps;
  bool same = true;  ///< every step's state was that of the recording
};

struct ProfileOptions {
  int replays = 3;
  double from_s = 0, seconds = 0;  ///< of the recording; 0 s: to its end
};

/// Throws LoadError if the file cannot be replayed.
StepCosts profile(const std::string& recording, const ProfileOptions& options);
/// Phases with their shares of all steps and of the slowest 0.1 %, and counts, mean and most.
void print_profile(const StepCosts& costs);
/// Runs a procedure as `ostium run` does, and replays it: its row, beside the depth of its instruments in the walls.
Row procedure_row(const std::string& vessel, const std::string& script, const ProfileOptions& options);

}  // namespace ostium::bench
