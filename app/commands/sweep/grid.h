#pragma once
/// The runs of a sweep: each case with each combination of values with each seed, in the order of the table. A part of
/// a sweep keeps it, so that what is missing can be named without the cases and the script.
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace ostium::app {

struct SweepGrid {
  std::vector<std::string> cases;
  std::string script;
  std::vector<std::string> keys;                 ///< that are varied
  std::vector<std::vector<std::string>> values;  ///< of each key; the last key's change fastest
  std::uint64_t first_seed = 0, last_seed = 0;

  std::size_t seeds() const { return static_cast<std::size_t>(last_seed - first_seed) + 1; }
  std::size_t combinations() const;                                       ///< of values
  std::size_t settings() const { return cases.size() * combinations(); }  ///< a case with a combination
  std::size_t runs() const { return settings() * seeds(); }
  std::size_t setting_of(std::size_t run) const { return run / seeds(); }
  std::uint64_t seed_of(std::size_t run) const { return first_seed + run % seeds(); }
  const std::string& case_of(std::size_t setting) const { return cases[setting / combinations()]; }
  std::vector<std::string> values_of(std::size_t setting) const;  ///< one of each key
  std::string words_of(std::size_t setting) const;                ///< "rca-mid-focal wire=rosen person=2"
  /// For files, "012-rca-mid-focal-rosen-2-7": the line of the table below its heading, from 1, and what it is.
  std::string name_of(std::size_t run) const;
};

/// Throws LoadError if there are more than a million runs, or no combination.
void require_size(const SweepGrid& grid);

nlohmann::ordered_json to_json(const SweepGrid& grid);
/// Throws LoadError or nlohmann::json::exception.
SweepGrid grid_from_json(const nlohmann::ordered_json& in);

}  // namespace ostium::app
