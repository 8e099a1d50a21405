#include "data/effects/nesting_clearance.h"

#include <Eigen/Geometry>
#include <cmath>

#include "data/effects/tools.h"

namespace ostium {

namespace {

constexpr double mm = 1e-3;
constexpr double least_per_m = 0.1;  // of what curvatures differ by: those that agree have no play to take up

std::string why_not(const MeasurementSet& set, std::optional<int>) {
  if (set.vessel) return "in a vessel instruments have their clearance";
  return set.instruments.size() > 1 ? "" : "nothing is nested";
}

const Section& section_at(const std::vector<Section>& sections, double from_tip) {
  for (const Section& s : sections)
    if (from_tip < s.to_tip_m) return s;
  return sections.back();
}

/// The same instrument without its last `length`.
void end_earlier(ConcentricPart& part, double length) {
  std::vector<Section> out;
  for (Section s : part.sections) {
    s.from_tip_m = out.empty() ? 0 : s.from_tip_m - length, s.to_tip_m -= length;
    if (s.to_tip_m - s.from_tip_m > 1e-6) out.push_back(s);
  }
  out.front().from_tip_m = 0;
  part.sections = out;
  part.inserted_m -= length;
}

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, Setup& setup) {
  auto& parts = setup.nest.parts;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    const double beyond = parts[i + 1].inserted_m - parts[i].inserted_m;
    if (beyond <= 0 || effect.values[0] <= 0) continue;
    const Eigen::Vector2d own = section_at(parts[i].sections, 0).rest_curvature_per_m.head<2>();
    const Eigen::Vector2d other = section_at(parts[i + 1].sections, beyond).rest_curvature_per_m.head<2>();
    // As their drives are turned; how they twist on the way is left out.
    const double differ =
        (Eigen::Rotation2Dd(parts[i].roll_rad) * own - Eigen::Rotation2Dd(parts[i + 1].roll_rad) * other).norm();
    end_earlier(parts[i], std::min(std::sqrt(3 * effect.values[0] * mm / std::max(differ, least_per_m)),
                                   0.4 * parts[i].inserted_m));
  }
}

/// What bores and radii say.
void adapt(const MeasurementSet& set, std::optional<int>, std::vector<EffectParameter>& p) {
  double most = 0;
  for (std::size_t i = 0; i + 1 < set.instruments.size(); ++i)
    most = std::max(most, set.instruments[i].inner_radius_m - set.instruments[i + 1].radius_m);
  p[0].spread = std::clamp(most / mm, 0.02, 0.3), p[0].most = std::max(4 * p[0].spread, 0.2);
}

}  // namespace

Effect nesting_clearance() {
  Effect effect;
  effect.id = "nesting_clearance";
  effect.what = "play between nested instruments";
  effect.parameters = {{"clearance_mm", "mm", "play on each side of the inner instrument", 0, 0.1, 0, 2, false}};
  effect.why_not = why_not, effect.apply = apply, effect.adapt = adapt;
  return effect;
}

}  // namespace ostium
