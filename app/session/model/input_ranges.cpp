#include "app/session/model/input_ranges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <string_view>

#include "core/base/tolerances.h"
#include "core/base/units.h"

namespace ostium::app {

namespace {

struct NamedRange {
  std::string_view name;  ///< without the tool, or an index
  InputRange range;
};

using units::atm;
// Wider than any patient or operator, but such that all that is computed from them stays finite.
constexpr NamedRange table[] = {
    {"advance_m_s", {-core::tolerances::max_drive_speed_m_s, core::tolerances::max_drive_speed_m_s}},
    {"turn_rad_s", {-core::tolerances::max_drive_turn_rad_s, core::tolerances::max_drive_turn_rad_s}},
    {"lao_rad", {-units::pi, units::pi}},
    {"cran_rad", {-units::pi / 2, units::pi / 2}},
    {"field_m", {0.05, 0.5}},
    {"isocentre_m", {-2, 2}},
    {"fluoroscopy", {0, 1}},
    {"cine", {0, 1}},
    {"heart_rate_1_min", {30, 220}},
    {"injection_m3_s", {0, 20e-6}},
    {"iodine_kg_m3", {0, 400}},
    {"aspiration_m3_s", {0, 20e-6}},
    {"gauge_Pa", {-atm, 30 * atm}},
    {"second_gauge_Pa", {-atm, 30 * atm}},
    {"heparin_U", {0, 30000, true}},
    {"nitrate_ug", {0, 1000, true}},
    {"adenosine_ug", {0, 1000, true}},
    {"drug", {-1, 100, true}},
    {"drug_dose", {0, 1000, true}},
    {"infusion_m3_s", {0, 20e-6}},
    {"drain_m3_s", {0, 10e-6}},
    {"shock_J", {0, 360, true}},
    {"compressions_1_min", {0, 180}},
    {"pacing_1_min", {0, 180}},
    {"pacing_mA", {0, 20}},
    {"breath_asked", {0, 2, true}},
    {"provoked", {0, vascular::provocations - 1, true}},
    {"provoked_cell", {-1, 1e6, true}},
    {"provoked_size", {0, 10, true}},
};

std::string_view without_owner_and_index(std::string_view name) {
  name = name.substr(name.rfind('.') + 1);
  return name.substr(0, name.find('['));
}

}  // namespace

std::vector<InputRange> input_ranges(const SessionModel& model) {
  std::vector<InputRange> ranges;
  for (const std::string& name : input_names(model)) {
    const auto* found = std::find_if(std::begin(table), std::end(table),
                                     [&](const NamedRange& one) { return one.name == without_owner_and_index(name); });
    assert(found != std::end(table));
    ranges.push_back(found->range);
  }
  return ranges;
}

std::string first_out_of_range(const std::vector<std::string>& names, const std::vector<InputRange>& ranges,
                               const double* row) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string_view name = without_owner_and_index(names[i]);
    if (name == "advance_m_s" || name == "turn_rad_s") continue;
    if (!(row[i] >= ranges[i].least && row[i] <= ranges[i].most))
      return fmt::format("{} is {:g}; expected a number from {:g} to {:g}", names[i], row[i], ranges[i].least,
                         ranges[i].most);
  }
  return "";
}

}  // namespace ostium::app
