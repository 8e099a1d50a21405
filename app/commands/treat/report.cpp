#include "app/commands/treat/report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/units.h"

namespace ostium::app {

using units::atm, units::mL;

using json = nlohmann::ordered_json;

json to_json(const InflationRecord& r) {
  return {{"device", r.device},
          {"gauge_atm", r.gauge_Pa / atm},
          {"diameter_mm", 1e3 * r.diameter_m},
          {"balloon_artery_ratio", r.largest_over_reference},
          {"waist_at_4_atm", r.waist_at_4_atm},
          {"waist_gave_at_atm", r.waist_gave_Pa > 0 ? json(r.waist_gave_Pa / atm) : json(nullptr)},
          {"slip_mm", 1e3 * r.slip_m},
          {"deflated_after_s", r.deflated_s},
          {"ST_shift_mV", r.ST_mV},
          {"burst", r.burst}};
}

json to_json(const StentNumbers& s) {
  return {{"minimal_diameter_mm", s.minimal_diameter_mm},
          {"minimal_area_mm2", s.minimal_area_mm2},
          {"expansion_percent", s.expansion_percent},
          {"apposed_percent", s.apposed_percent},
          {"worst_gap_mm", s.worst_gap_mm},
          {"recoil_percent", s.recoil_percent},
          {"foreshortening_percent", s.foreshortening_percent},
          {"stent_margin_proximal_mm", s.margin_proximal_mm},
          {"stent_margin_distal_mm", s.margin_distal_mm},
          {"lesion_coverage_percent", s.coverage_percent}};
}

json to_json(const vascular::InjuryState& state, const vascular::FlowTree& tree) {
  json out = json::array();
  for (const vascular::Injury& injury : state.injuries)
    if (injury.cell >= 0)
      out.push_back({{"kind", injury.kind == vascular::InjuryKind::dissection ? "dissection" : "perforation"},
                     {"grade", grade_name(injury)},
                     {"branch", tree.branches[tree.cells[static_cast<std::size_t>(injury.cell)].branch].name},
                     {"outside_mL", injury.outside_m3 / mL}});
  return out;
}

namespace {

void print_lesion(const json& lesion) {
  fmt::print("{}\n  {:<28} {:>9} {:>9}\n", lesion["place"].get<std::string>(), "", "before", "after");
  for (const auto& [key, value] : lesion["before"].items()) {
    const json& after = lesion["after"][key];
    const auto number = [](const json& n) { return n.is_number() ? fmt::format("{:.2f}", n.get<double>()) : "none"; };
    fmt::print("  {:<28} {:>9} {:>9}\n", key, number(value), number(after));
  }
  if (lesion.contains("stent"))
    for (const auto& [key, value] : lesion["stent"].items())
      fmt::print("  {:<28} {:>9} {:>9.2f}\n", key, "", value.get<double>());
  for (const json& i : lesion["inflations"])
    fmt::print("  {:<38} {:4.0f} atm, {:.2f} mm, ratio {:.2f}, waist at 4 atm {:.2f}{}{}\n",
               i["device"].get<std::string>(), i["gauge_atm"].get<double>(), i["diameter_mm"].get<double>(),
               i["balloon_artery_ratio"].get<double>(), i["waist_at_4_atm"].get<double>(),
               std::fabs(i["slip_mm"].get<double>()) > 0.5 ? ", slipped" : "", i["burst"].get<bool>() ? ", BURST" : "");
}

}  // namespace

void print_treatment(const json& report) {
  for (const json& lesion : report["lesions"]) print_lesion(lesion);
  for (const json& injury : report["injuries"])
    fmt::print("injury: {} {} in {}\n", injury["kind"].get<std::string>(), injury["grade"].get<std::string>(),
               injury["branch"].get<std::string>());
  if (report.contains("file")) fmt::print("{}\n", report["file"].get<std::string>());
}

}  // namespace ostium::app
