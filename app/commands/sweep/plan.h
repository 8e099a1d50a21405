#pragma once
/// Which runs a sweep consists of.
#include "app/commands/run/session_arguments.h"

namespace ostium::app {

struct SweepArguments {
  std::vector<std::string> vessels;
  SessionArguments session;  ///< without vessel and seed
  std::string seeds = "1..10";
  std::vector<std::string> vary;  ///< KEY=A,B,C
  int jobs = 0;                   ///< 0: one for each core
  bool resume = false;
  std::string table;
};

struct SweepTask {
  std::size_t vessel = 0;           ///< of those that are made
  std::vector<std::string> values;  ///< of the varied keys
  std::uint64_t seed = 0;
  RunSetup setup;  ///< without mesh
};

/// A sweep as it was asked for: runs in the order of the table.
struct Sweep {
  std::vector<std::string> keys;
  std::vector<RunSetup> vessels;  ///< one for each vessel that has to be made
  std::vector<SweepTask> tasks;
};

/// Throws LoadError or MeshError.
Sweep plan_sweep(const SweepArguments& arguments);

}  // namespace ostium::app
