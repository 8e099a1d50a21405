#include "app/command_line/patient_options.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <set>

#include "app/command_line/arguments.h"
#include "data/formats/decimal.h"
#include "data/formats/load_error.h"

namespace ostium::app {

void add_patient_option(Options& options, std::vector<std::string>& set) {
  options.add("--set", set, "Of a case: person (a whole number; 0 is the mean), heart_rate (beats a minute)")
      .type("KEY=VALUE");
}

data::Case case_with(const std::string& name, const std::vector<std::string>& set) {
  data::Case c = data::find_case(name);
  std::set<std::string> known;
  for (const std::string& one : set) {
    const auto [key, value] = key_and_value(one);
    if (!known.insert(key).second)
      throw data::LoadError(fmt::format("--set {}: {} is set already; expected one value", one, key));
    const std::optional<double> number = data::decimal(value);
    if (key == "person") {
      if (!number || *number < 0 || *number > 9e15 || *number != std::floor(*number))
        throw data::LoadError(fmt::format("person is \"{}\"; expected a whole number from 0 on", value));
      c = with_person(c, static_cast<std::uint64_t>(*number));
    } else if (key == "heart_rate") {
      if (!number || *number < 40 || *number > 180)
        throw data::LoadError(fmt::format("heart_rate is \"{}\"; expected beats a minute, 40 to 180", value));
      c.rate_1_min = *number;
    } else {
      throw data::LoadError(fmt::format("--set {}: expected person=N or heart_rate=N", one));
    }
  }
  return c;
}

}  // namespace ostium::app
