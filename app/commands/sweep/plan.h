#pragma once
/// Expands a sweep into its runs.
#include "app/commands/run/session_arguments.h"

namespace ostium::app {

struct SweepArguments {
  std::vector<std::string> vessels;
  SessionArguments session;  ///< without vessel and seed
  std::string seeds = "1..10";
  std::vector<std::string> vary;  ///< KEY=A,B,C
  int jobs = 0;                   ///< 0: one per core
  bool resume = false;
  std::string table;
};

struct SweepTask {
  std::size_t vessel = 0;           ///< index into the sweep's vessels
  std::vector<std::string> values;  ///< of the varied keys
  std::uint64_t seed = 0;
  RunSetup setup;  ///< without mesh
};

/// A sweep: its runs in the order of the table.
struct Sweep {
  std::vector<std::string> keys;
  std::vector<RunSetup> vessels;  ///< one for each vessel to be built
  std::vector<SweepTask> tasks;
};

/// Throws LoadError or MeshError.
Sweep plan_sweep(const SweepArguments& arguments);

}  // namespace ostium::app
