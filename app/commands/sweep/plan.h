#pragma once
/// Expands a sweep into its runs.
#include "app/commands/run/session_arguments.h"
#include "app/commands/sweep/grid.h"

namespace ostium::app {

struct SweepArguments {
  std::vector<std::string> vessels;
  SessionArguments session;  ///< without vessel and seed
  std::string seeds = "1..10";
  std::vector<std::string> vary;  ///< KEY=A,B,C
  int jobs = 0;                   ///< 0: one per core
  bool resume = false;
  std::string table;
  std::string part;    ///< K/N or auto; empty: all of it
  std::string merge;   ///< a table, whose parts are put together; empty: the sweep is run
  std::string keep;    ///< folder for what each run recorded; empty: nothing is kept
  std::string record;  ///< none, events, full; empty: events with `keep`, else none
};

struct Sweep {
  SweepGrid grid;
  std::vector<RunSetup> vessels;       ///< one for each vessel to be built
  std::vector<RunSetup> settings;      ///< of the grid's, without mesh and seed
  std::vector<std::size_t> vessel_of;  ///< index into `vessels` of each setting
  double seconds = 0;                  ///< most that are simulated of each run; 0: no limit
};

/// Throws LoadError or MeshError.
Sweep plan_sweep(const SweepArguments& arguments);

/// Of a run, without mesh.
RunSetup setup_of(const Sweep& sweep, std::size_t run);

}  // namespace ostium::app
