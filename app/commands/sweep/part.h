#pragma once
/// A part of a sweep, for one of several processes that know nothing of each other.
#include <string>
#include <vector>

namespace ostium::app {

inline constexpr std::size_t most_parts = 100'000;

struct SweepPart {
  std::size_t number = 1, of = 1;  ///< counted from 1
  bool is_all = true;              ///< no part was asked for
};

/// "K/N", or "auto": by the rank that Slurm or mpirun gives this process. An array's tasks and the processes within one
/// of them multiply. Throws LoadError.
SweepPart part_from(const std::string& text);

/// The part that each run belongs to, from 1. `vessel_of_run` counts `vessels`. Whole vessels go to a part; where there
/// are more parts than vessels, parts share a vessel, and each of them builds it.
std::vector<std::size_t> parts_of_runs(const std::vector<std::size_t>& vessel_of_run, std::size_t vessels,
                                       std::size_t parts);

/// Where a part keeps its runs: "table.csv.part-2-of-8"; "table.csv.part" of a sweep in one process.
std::string part_file(const std::string& table, const SweepPart& part);

}  // namespace ostium::app
