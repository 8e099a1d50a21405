#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "data/catalogue/case/case.h"
#include "fluoro/projection/views.h"

namespace ostium::data {

namespace {

using units::per_mm;
const char* const dominances[] = {"right", "left", "balanced"};
const char* const types[] = {"A", "B", "C"};

std::string access_text(const Case& c) {
  return c.imported ? "imported" : access_names()[static_cast<std::size_t>(c.anatomy.access)];
}
std::string dominance_text(const Case& c) {
  return c.imported ? "imported" : dominances[static_cast<int>(c.anatomy.dominance)];
}

std::string lesion_text(const vascular::Lesion& lesion) {
  return fmt::format("{} at {:.0f} mm: {:.0f} % over {:.0f} mm, {}{}, type {}", lesion.branch, lesion.from_m * per_mm,
                     100 * lesion.stenosis, lesion.length_m * per_mm, lesion.eccentric ? "eccentric" : "concentric",
                     lesion.made_of.calcified() ? ", calcified" : "", types[static_cast<int>(type_of(lesion))]);
}

}  // namespace

std::string case_heading() { return fmt::format("{:<32} {:<8} {:<9} {}", "case", "access", "dominance", "lesions"); }

std::string case_line(const Case& c) {
  std::string lesions;
  for (const vascular::Lesion& lesion : c.lesions) lesions += (lesions.empty() ? "" : "; ") + lesion_text(lesion);
  return fmt::format("{:<32} {:<8} {:<9} {}", c.name, access_text(c), dominance_text(c), lesions);
}

std::string case_details(const Case& c) {
  std::string text =
      fmt::format("{}: {}\n  history  {}\n  ECG      {}\n  access   {}\n  heart    {:.0f} beats a minute\n", c.name,
                  c.title, c.card.history, c.card.ecg, c.card.planned_access, c.rate_1_min);
  for (const vascular::Lesion& lesion : c.lesions) text += "  lesion   " + lesion_text(lesion) + "\n";
  for (const CaseView& view : c.views)
    text += fmt::format("  view     {}: {}\n", view.name, fluoro::angles_text(view.lao_deg, view.cran_deg));
  const vascular::Anatomy anatomy = anatomy_of(c);
  text += fmt::format("  {:<22} {:>9} {:>12} {:>10}\n", "branch", "length mm", "proximal mm", "distal mm");
  for (const vascular::NamedBranch& b : anatomy.branches)
    if (b.length_m() > 0)
      text += fmt::format("  {:<22} {:9.1f} {:12.2f} {:10.2f}\n", b.name, b.length_m() * per_mm,
                          2 * per_mm * anatomy.tubes[b.tube].at(b.from_m).radius_m,
                          2 * per_mm * anatomy.tubes[b.tube].at(b.to_m).radius_m);
  return text;
}

std::string to_json(const std::vector<Case>& cases) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Case& c : cases) {
    nlohmann::ordered_json lesions = nlohmann::ordered_json::array();
    for (const vascular::Lesion& l : c.lesions)
      lesions.push_back({{"branch", l.branch},
                         {"from_mm", l.from_m * per_mm},
                         {"length_mm", l.length_m * per_mm},
                         {"stenosis_percent", 100 * l.stenosis},
                         {"shape", l.eccentric ? "eccentric" : "concentric"},
                         {"calcified", l.made_of.calcified()},
                         {"type", types[static_cast<int>(type_of(l))]}});
    all.push_back({{"name", c.name},
                   {"title", c.title},
                   {"access", access_text(c)},
                   {"dominance", dominance_text(c)},
                   {"seed", c.seed},
                   {"heart_rate_1_min", c.rate_1_min},
                   {"history", c.card.history},
                   {"ecg", c.card.ecg},
                   {"planned_access", c.card.planned_access},
                   {"lesions", lesions}});
  }
  return all.dump(2);
}

}  // namespace ostium::data
