#pragma once
#include "app/run_command.h"

namespace ostium {

struct SweepOptions {
  std::vector<std::string> vessels;
  RunOptions run;  ///< script, set, seconds, and what a mesh needs
  std::string seeds = "1..10";
  std::vector<std::string> vary;  ///< KEY=A,B,C
  int jobs = 0;
  bool resume = false;
  std::string table;
};

/// `ostium sweep`. 0 if every run came to an end, whatever its outcome. Throws LoadError or MeshError.
int sweep_command(const SweepOptions& options);

}  // namespace ostium
