#include "app/commands/sweep/part.h"

#include <fmt/format.h>

#include <cstdlib>
#include <optional>

#include "data/formats/decimal.h"
#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

/// A place among several, from 0.
struct Rank {
  std::size_t at = 0, of = 1;
};

std::optional<std::size_t> number_in(const char* variable) {
  const char* const text = std::getenv(variable);
  if (!text || !*text) return std::nullopt;
  const std::optional<std::uint64_t> number = data::whole(text);
  if (!number) throw data::LoadError(fmt::format("{} is \"{}\"; expected a whole number from 0 on", variable, text));
  return static_cast<std::size_t>(*number);
}

/// A process of several. Within a step of Slurm, mpirun's own processes tell more than the step's; outside of a step (a
/// batch script) there is one process, whatever number of them the job may have.
std::optional<Rank> rank_of_process() {
  struct Names {
    const char *at, *of, *only_with;
  };
  for (const Names& names :
       {Names{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", nullptr}, Names{"PMI_RANK", "PMI_SIZE", nullptr},
        Names{"SLURM_PROCID", "SLURM_STEP_NUM_TASKS", "SLURM_STEP_ID"},
        Names{"SLURM_PROCID", "SLURM_NTASKS", "SLURM_STEP_ID"}}) {
    if (names.only_with && !std::getenv(names.only_with)) continue;
    const auto at = number_in(names.at), of = number_in(names.of);
    if (at && of) return Rank{*at, *of};
  }
  return std::nullopt;
}

std::optional<Rank> rank_in_array() {
  const auto id = number_in("SLURM_ARRAY_TASK_ID"), least = number_in("SLURM_ARRAY_TASK_MIN"),
             count = number_in("SLURM_ARRAY_TASK_COUNT");
  if (!id || !least || !count) return std::nullopt;
  const std::size_t apart = number_in("SLURM_ARRAY_TASK_STEP").value_or(1);
  if (*id < *least || apart == 0 || (*id - *least) % apart != 0 || (*id - *least) / apart >= *count)
    throw data::LoadError(fmt::format(
        "the array's tasks are no range (task {} of {} that begin at {}); expected --array=FROM-TO, or --part K/N", *id,
        *count, *least));
  return Rank{(*id - *least) / apart, *count};
}

SweepPart part_by_rank() {
  const std::optional<Rank> array = rank_in_array(), process = rank_of_process();
  if (!array && !process)
    throw data::LoadError(
        "--part auto: this is no task of a Slurm array (SLURM_ARRAY_TASK_ID, _MIN, _COUNT), of srun (SLURM_PROCID) or "
        "of mpirun (OMPI_COMM_WORLD_RANK, PMI_RANK); expected one of these, or --part K/N");
  const Rank outer = array.value_or(Rank{}), inner = process.value_or(Rank{});
  if (inner.at >= inner.of || outer.of > most_parts || inner.of > most_parts || outer.of * inner.of > most_parts)
    throw data::LoadError(fmt::format("--part auto: process {} of {} in task {} of {}; expected at most {} in all",
                                      inner.at, inner.of, outer.at, outer.of, most_parts));
  return {outer.at * inner.of + inner.at + 1, outer.of * inner.of, false};
}

}  // namespace

SweepPart part_from(const std::string& text) {
  if (text.empty()) return {};
  if (text == "auto") return part_by_rank();
  const auto slash = text.find('/');
  if (slash != std::string::npos) {
    const auto number = data::whole(text.substr(0, slash)), of = data::whole(text.substr(slash + 1));
    if (number && of && *number >= 1 && *number <= *of && *of <= most_parts) return {*number, *of, false};
  }
  throw data::LoadError(
      fmt::format("--part is \"{}\"; expected K/N, K from 1 to N, N at most {}, or auto", text, most_parts));
}

std::vector<std::size_t> parts_of_runs(const std::vector<std::size_t>& vessel_of_run, std::size_t vessels,
                                       std::size_t parts) {
  std::vector<std::size_t> of_run, seen(vessels, 0);
  of_run.reserve(vessel_of_run.size());
  for (const std::size_t vessel : vessel_of_run) {
    if (vessels >= parts) {
      of_run.push_back(vessel % parts + 1);
      continue;
    }
    const std::size_t sharers = (parts - vessel + vessels - 1) / vessels;  // parts vessel, vessel + vessels, ...
    of_run.push_back(vessel + vessels * (seen[vessel]++ % sharers) + 1);
  }
  return of_run;
}

std::string part_file(const std::string& table, const SweepPart& part) {
  return part.is_all ? table + ".part" : fmt::format("{}.part-{}-of-{}", table, part.number, part.of);
}

}  // namespace ostium::app
