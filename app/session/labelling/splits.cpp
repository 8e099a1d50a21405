#include "app/session/labelling/splits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "data/catalogue/case/case.h"

namespace ostium::app {

const char* split_name(Split split) { return split == Split::train ? "train" : split == Split::val ? "val" : "test"; }

std::vector<Split> splits_of(const std::vector<std::string>& persons) {
  const std::set<std::string> different(persons.begin(), persons.end());
  std::vector<std::string> order(different.begin(), different.end());
  const auto number = [](const std::string& person) { return std::hash<std::string>{}(person); };
  std::stable_sort(order.begin(), order.end(),
                   [&](const std::string& a, const std::string& b) { return number(a) < number(b); });
  const auto apart = static_cast<std::size_t>(std::lround(0.15 * static_cast<double>(order.size())));
  std::map<std::string, Split> split_of;
  for (std::size_t i = 0; i < order.size(); ++i)
    split_of[order[i]] = i < apart ? Split::val : i < 2 * apart ? Split::test : Split::train;
  std::vector<Split> out;
  for (const std::string& person : persons) out.push_back(split_of[person]);
  return out;
}

std::string person_of(const RunSetup& setup) {
  if (setup.person) return fmt::format("person {}", *setup.person);
  if (setup.is_mesh()) return setup.vessel;
  const data::Case c = data::read_case(setup.vessel + ".json", setup.case_text);
  return c.imported ? setup.vessel : fmt::format("person {}", c.seed);
}

}  // namespace ostium::app
