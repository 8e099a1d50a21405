#include "vascular/treatment/plaque.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace ostium::vascular {

namespace {

constexpr double whole_plaque = 0.3;  // narrowing from which the wall is all plaque

/// Radius up to which the plaque gave way, beyond which it is stiff.
double open_m(const PlaqueModel& model, const PlaqueCell& cell, double rest_m) {
  return cell.diseased_m + (rest_m - cell.diseased_m) / (1 - model.law.spring_back);
}

/// What a cell's plaque does at its state: how far it was opened, where it yields, and its stiffness until then.
struct Strength {
  double open_m = 0, share = 0;  ///< of what the lumen lost
  double spring_Pa = 0;          ///< pressure at open_m
  double yield_Pa = 0, E_Pa = 0;
};

Strength strength_of(const PlaqueModel& model, const PlaqueState& s, int i) {
  const PlaqueCell& cell = model.cells[i];
  const double lost = cell.healthy_m - cell.diseased_m;
  Strength is{.open_m = open_m(model, cell, s.rest_m[i])};
  is.share = lost > 1e-9 ? (is.open_m - cell.diseased_m) / lost : 1;
  is.spring_Pa = model.law.spring_Pa * (is.open_m - s.rest_m[i]) / cell.healthy_m;
  const double free = 1 - model.law.calcium_holds * cell.calcium_arc_share * (1 - s.cracked[i]);
  is.yield_Pa = cell.yield_Pa * (1 - model.law.weakening * s.broken[i]) +
                cell.hardening_Pa * std::clamp(is.share, 0.0, 1.0) / free;
  is.E_Pa = cell.E_Pa * std::max(1.0, is.yield_Pa / cell.yield_Pa);
  return is;
}

void compose(const Lesion& lesion, double s_m, PlaqueCell& cell, double& hardness) {
  cell.calcified = cell.calcified || lesion.made_of.calcified();
  cell.eccentric = cell.eccentric || lesion.eccentric;
  hardness = std::max(hardness, lesion.made_of.hardness);
  const double from_middle = std::fabs(s_m - lesion.from_m - lesion.length_m / 2);
  if (from_middle > lesion.made_of.calcium_length_share * lesion.length_m / 2) return;
  cell.calcium_arc_share = std::max(cell.calcium_arc_share, lesion.made_of.calcium_arc_rad / (2 * units::pi));
  cell.calcium_m = std::max(cell.calcium_m, lesion.made_of.calcium_thickness_m);
}

}  // namespace

PlaqueModel make_plaque_model(const FlowTree& tree, const std::vector<Lesion>& lesions, const PlaqueLaw& law) {
  PlaqueModel model{law, {}};
  for (const FlowCell& from : tree.cells) {
    PlaqueCell cell{.diseased_m = from.diseased_m, .healthy_m = from.healthy_m};
    double hardness = 0;
    for (const Lesion& lesion : lesions)
      if (lesion.branch == tree.branches[from.branch].name && from.s_m >= lesion.from_m &&
          from.s_m <= lesion.from_m + lesion.length_m)
        compose(lesion, from.s_m, cell, hardness);
    const double burden = std::clamp((1 - cell.diseased_m / cell.healthy_m) / whole_plaque, 0.0, 1.0),
                 plaque_Pa = law.yield_Pa / law.yield_strain;
    cell.E_Pa = law.healthy_Pa + burden * (plaque_Pa - law.healthy_Pa);
    // All plaque yields at the same strain; a healthy wall does not yield.
    const double part = cell.E_Pa / plaque_Pa, never = 2 * std::exp(-burden / 0.08);
    cell.yield_Pa = part * law.yield_Pa + never * cell.E_Pa;
    cell.hardening_Pa = part * law.hardening_Pa * (hardness > 0 ? hardness : 1);
    model.cells.push_back(cell);
  }
  return model;
}

PlaqueState make_plaque_state(const PlaqueModel& model) {
  PlaqueState s;
  for (const PlaqueCell& cell : model.cells) s.rest_m.push_back(cell.diseased_m);
  s.peak_m = s.radius_m = s.rest_m;
  s.broken.assign(model.cells.size(), 0), s.cracked = s.broken;
  return s;
}

WallLaw wall_law(const PlaqueModel& model, const PlaqueState& s, int i) {
  const Strength is = strength_of(model, s, i);
  return {.healthy_m = model.cells[i].healthy_m,
          .rest_m = s.rest_m[i],
          .open_m = is.open_m,
          .E_s_Pa = model.law.spring_Pa,
          .E_Pa = is.E_Pa,
          .open_Pa = is.spring_Pa,
          .yield_Pa = is.yield_Pa,
          .media_Pa = model.law.media_Pa,
          .media_k = model.law.media_k};
}

WallPressure WallLaw::at(double a) const {
  if (a <= rest_m) return {};
  WallPressure out{E_s_Pa * (a - rest_m) / healthy_m, E_s_Pa / healthy_m};
  if (a > open_m) out = {open_Pa + E_Pa * (a - open_m) / healthy_m, E_Pa / healthy_m};
  if (out.p_Pa > yield_Pa) out = {yield_Pa, 0.02 * out.slope_Pa_m};
  if (a > healthy_m) {
    const double x = a / healthy_m, grown = media_Pa * std::exp(std::min(30.0, media_k * (x * x - 1)));
    out.p_Pa += grown - media_Pa;
    out.slope_Pa_m += grown * media_k * 2 * x / healthy_m;
  }
  return out;
}

WallPressure wall_pressure(const PlaqueModel& model, const PlaqueState& s, int i, double a) {
  return a <= s.rest_m[i] ? WallPressure{} : wall_law(model, s, i).at(a);
}

void push_wall(const PlaqueModel& model, int i, double a, PlaqueState& s) {
  const PlaqueCell& cell = model.cells[i];
  s.peak_m[i] = std::max(s.peak_m[i], a);
  // Elastic up to the yield limit; the rest is permanent. Cracks and hardening are taken at the beginning of the step,
  // which is accurate enough for small steps.
  if (const Strength is = strength_of(model, s, i); a > is.open_m) {
    const double elastic_m = (is.yield_Pa - is.spring_Pa) / is.E_Pa * cell.healthy_m,
                 p_Pa = is.spring_Pa + (is.yield_Pa - is.spring_Pa) * std::min(1.0, (a - is.open_m) / elastic_m);
    if (cell.calcium_arc_share > 0.5 && p_Pa * a > model.law.calcium_Pa * cell.calcium_m) s.cracked[i] = 1;
    if (const double given_m = a - is.open_m - elastic_m; given_m > 0) {
      s.rest_m[i] += (1 - model.law.spring_back) * given_m;
      if (const double lost = cell.healthy_m - cell.diseased_m; lost > 1e-9)
        s.broken[i] = std::min(1.0, s.broken[i] + given_m / lost / model.law.crack);
    }
  }
  s.radius_m[i] = std::max(a, s.rest_m[i]);
}

}  // namespace ostium::vascular
