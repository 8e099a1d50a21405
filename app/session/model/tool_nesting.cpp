#include "app/session/model/tool_nesting.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/rod/introducer.h"
#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

constexpr double wire_friction = 0.05;  // wire in a catheter: PTFE on steel, an estimate

bool has_lumen(const data::Instrument& instrument) { return instrument.inner_diameter_m > 0; }

/// Whether the tool runs over another wire than this one.
bool runs_over_another(const SessionTool& tool, const SessionTool& wire) {
  return !tool.over.empty() && wire.instrument.kind == data::InstrumentKind::wire && wire.name != tool.over;
}

/// Throws LoadError where a tool cannot run over what it is said to, or several wires go through it and nothing is
/// said.
void require_rails(const std::vector<SessionTool>& tools) {
  for (std::size_t i = 0; i < tools.size(); ++i) {
    const SessionTool& tool = tools[i];
    std::vector<std::string> wires;
    for (std::size_t j = i + 1; j < tools.size(); ++j)
      if (tools[j].instrument.kind == data::InstrumentKind::wire && has_lumen(tool.instrument) &&
          fits_inside(tools[j].instrument, tool.instrument))
        wires.push_back(tools[j].name);
    const bool is_device = tool.instrument.balloon.has_value();
    const std::string known = wires.empty() ? "no wire goes through it" : fmt::format("{}", fmt::join(wires, " or "));
    if (!tool.over.empty() && std::ranges::find(wires, tool.over) == wires.end())
      throw data::LoadError(fmt::format("{} runs over \"{}\"; expected {}", tool.name, tool.over, known));
    if (is_device && tool.over.empty() && wires.size() > 1)
      throw data::LoadError(
          fmt::format("{} goes over {}: say which, as \"over\": \"{}\"", tool.name, known, wires.front()));
  }
}

void require_order(const std::vector<SessionTool>& tools) {
  for (std::size_t i = 0; i < tools.size(); ++i)
    for (std::size_t j = i + 1; j < tools.size(); ++j)
      if (has_lumen(tools[j].instrument) && fits_inside(tools[i].instrument, tools[j].instrument))
        throw data::LoadError(fmt::format("{} ({}) goes inside {} ({}): list the outer tool first", tools[i].name,
                                          tools[i].instrument.name, tools[j].name, tools[j].instrument.name));
}

/// Widest diameter of a rod beyond `from_tip_m`.
double widest_m(const core::Rod& rod, double from_tip_m = 0) {
  double most = 0;
  for (const core::Section& s : rod.sections)
    if (s.to_tip_m > from_tip_m) most = std::max(most, s.radius_m);
  return 2 * most;
}

double narrowest_lumen_m(const core::Rod& rod) {
  double least = rod.sections.front().inner_radius_m;
  for (const core::Section& s : rod.sections) least = std::min(least, s.inner_radius_m);
  return 2 * least;
}

/// Whether something runs in both: two balloons for one wire.
bool share_a_rail(const SessionModel& model, int a, int b) {
  for (int inner = std::max(a, b) + 1; inner < static_cast<int>(model.tools.size()); ++inner)
    if (is_nested(model.rods.nestings, a, inner) && is_nested(model.rods.nestings, b, inner)) return true;
  return false;
}

}  // namespace

void require_nesting(const std::vector<SessionTool>& tools) {
  require_order(tools);
  require_rails(tools);
}

std::vector<core::Nesting> nestings_of(const std::vector<SessionTool>& tools) {
  std::vector<core::Nesting> nestings;
  for (int inner = 1; inner < static_cast<int>(tools.size()); ++inner)
    for (int outer = 0; outer < inner; ++outer) {
      const data::Instrument &a = tools[outer].instrument, &b = tools[inner].instrument;
      if (!has_lumen(a) || !fits_inside(b, a) || runs_over_another(tools[outer], tools[inner])) continue;
      core::Nesting nesting{.outer = outer, .inner = inner, .friction = wire_friction};
      if (a.wire_lumen && a.wire_lumen->rapid_exchange) nesting.lumen_m = a.wire_lumen->length_m;
      nestings.push_back(nesting);
    }
  return nestings;
}

Obstacle in_the_way(const SessionModel& model, const core::State& rods, int tool) {
  const auto rod = [&](int t) -> const core::Rod& { return model.rods.rods[static_cast<std::size_t>(t)]; };
  const auto is_in = [&](int t) { return in_body(rod(t), rods.rods[static_cast<std::size_t>(t)]); };
  int outer = -1;  // the last rod that the tool runs in
  for (int t = 0; t < tool; ++t)
    if (is_in(t) && is_nested(model.rods.nestings, t, tool)) outer = t;
  // Instruments side by side: the two widest must fit, and leave the room that round things waste.
  constexpr double filled = 0.8, tip_m = 30e-3;
  const double widest = widest_m(rod(tool));
  double next = 0, area = widest * widest;
  int beside = -1;
  for (int other = 0; other < static_cast<int>(model.tools.size()); ++other) {
    if (other == tool || !is_in(other) || is_nested(model.rods.nestings, std::min(tool, other), std::max(tool, other)))
      continue;
    if (outer < 0 || !is_nested(model.rods.nestings, outer, other) || share_a_rail(model, tool, other))
      return {other, 0};
    const double own = widest_m(rod(other), tip_m);  // its balloon has left the lumen
    area += own * own;
    if (own > next) next = own, beside = other;
  }
  const double lacks_m =
      beside < 0 ? 0 : std::max(widest + next, std::sqrt(area / filled)) - narrowest_lumen_m(rod(outer));
  return lacks_m > 0 ? Obstacle{beside, lacks_m} : Obstacle{};
}

}  // namespace ostium::app
