#include "app/commands/sweep/grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

constexpr std::size_t most_runs = 1'000'000;

}  // namespace

std::size_t SweepGrid::combinations() const {
  std::size_t count = 1;
  for (const auto& own : values) count *= own.size();
  return count;
}

std::vector<std::string> SweepGrid::values_of(std::size_t setting) const {
  std::vector<std::string> out(values.size());
  for (std::size_t k = values.size(); k-- > 0; setting /= values[k].size())
    out[k] = values[k][setting % values[k].size()];
  return out;
}

std::string SweepGrid::words_of(std::size_t setting) const {
  std::string words = case_of(setting);
  const std::vector<std::string> own = values_of(setting);
  for (std::size_t k = 0; k < keys.size(); ++k) words += fmt::format(" {}={}", keys[k], own[k]);
  return words;
}

std::string SweepGrid::name_of(std::size_t run) const {
  const std::size_t setting = setting_of(run), digits = std::to_string(runs()).size();
  std::string name =
      fmt::format("{:0{}}-{}", run + 1, digits, std::filesystem::path(case_of(setting)).filename().string());
  for (const std::string& value : values_of(setting)) name += "-" + value;
  name = fmt::format("{:.150}-{}", name, seed_of(run));
  const auto odd = [](char c) { return !std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-'; };
  std::replace_if(name.begin(), name.end(), odd, '_');
  return name;
}

void require_size(const SweepGrid& grid) {
  std::size_t runs = 1;
  const auto times = [&](std::uint64_t count) {
    if (count == 0 || count > most_runs / runs)
      throw data::LoadError(
          fmt::format("the sweep has {} runs; expected fewer: vessels times values of --vary times --seeds",
                      count == 0 ? "no" : fmt::format("more than {}", most_runs)));
    runs *= count;
  };
  times(grid.last_seed - grid.first_seed + 1);
  times(grid.cases.size());
  for (const auto& own : grid.values) times(own.size());
}

nlohmann::ordered_json to_json(const SweepGrid& grid) {
  return {{"cases", grid.cases},
          {"script", grid.script},
          {"keys", grid.keys},
          {"values", grid.values},
          {"seeds", {grid.first_seed, grid.last_seed}}};
}

SweepGrid grid_from_json(const nlohmann::ordered_json& in) {
  SweepGrid grid{.cases = in.at("cases"),
                 .script = in.at("script"),
                 .keys = in.at("keys"),
                 .values = in.at("values"),
                 .first_seed = in.at("seeds").at(0),
                 .last_seed = in.at("seeds").at(1)};
  if (grid.keys.size() != grid.values.size() || grid.last_seed < grid.first_seed)
    throw data::LoadError("the sweep that it is of cannot be read");
  require_size(grid);
  return grid;
}

}  // namespace ostium::app
