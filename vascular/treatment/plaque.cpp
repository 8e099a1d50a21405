#include "vascular/treatment/plaque.h"

#include <algorithm>
#include <cmath>

namespace ostium::vascular {

namespace {

constexpr double whole_plaque = 0.3;  // narrowing from which the wall is all plaque

double opened(const PlaqueCell& cell, double rest_m) {
  const double lost = cell.healthy_m - cell.diseased_m;
  return lost > 1e-9 ? (rest_m - cell.diseased_m) / lost : 1;
}

double yield_of(const PlaqueModel& model, const PlaqueCell& cell, double broken, double rest_m) {
  return cell.yield_Pa * (1 - model.law.weakening * broken) +
         cell.hardening_Pa * std::clamp(opened(cell, rest_m), 0.0, 1.0);
}

}  // namespace

PlaqueModel make_plaque_model(const FlowTree& tree, const std::vector<Lesion>& lesions, const PlaqueLaw& law) {
  PlaqueModel model{law, {}};
  for (const FlowCell& from : tree.cells) {
    PlaqueCell cell{.diseased_m = from.diseased_m, .healthy_m = from.healthy_m};
    for (const Lesion& lesion : lesions) {
      if (lesion.branch != tree.branches[from.branch].name) continue;
      if (from.s_m < lesion.from_m || from.s_m > lesion.from_m + lesion.length_m) continue;
      cell.calcified = cell.calcified || lesion.calcified;
      cell.eccentric = cell.eccentric || lesion.eccentric;
    }
    const double burden = std::clamp((1 - cell.diseased_m / cell.healthy_m) / whole_plaque, 0.0, 1.0);
    const double c = cell.calcified;
    const double plaque = (1 - c) * law.soft_Pa + c * law.calcified_Pa;
    cell.E_Pa = law.healthy_Pa + burden * (plaque - law.healthy_Pa);
    // All plaque yields at the same strain; a healthy wall does not yield.
    const double part = cell.E_Pa / plaque, never = 2 * std::exp(-burden / 0.08);
    cell.yield_Pa = part * ((1 - c) * law.soft_yield_Pa + c * law.calcified_yield_Pa) + never * cell.E_Pa;
    cell.hardening_Pa = part * ((1 - c) * law.soft_hardening_Pa + c * law.calcified_hardening_Pa);
    model.cells.push_back(cell);
  }
  return model;
}

PlaqueState make_plaque_state(const PlaqueModel& model) {
  PlaqueState s;
  for (const PlaqueCell& cell : model.cells) s.rest_m.push_back(cell.diseased_m);
  s.peak_m = s.radius_m = s.rest_m;
  s.broken.assign(model.cells.size(), 0);
  return s;
}

WallPressure wall_pressure(const PlaqueModel& model, const PlaqueState& s, int i, double a) {
  const PlaqueCell& cell = model.cells[i];
  if (a <= s.rest_m[i]) return {};
  WallPressure out{cell.E_Pa * (a - s.rest_m[i]) / cell.healthy_m, cell.E_Pa / cell.healthy_m};
  const double most = yield_of(model, cell, s.broken[i], s.rest_m[i]);
  if (out.p_Pa > most) out = {most, 0.02 * out.slope_Pa_m};
  if (a > cell.healthy_m) {
    const double x = a / cell.healthy_m,
                 grown = model.law.media_Pa * std::exp(std::min(30.0, model.law.media_k * (x * x - 1)));
    out.p_Pa += grown - model.law.media_Pa;
    out.slope_Pa_m += grown * model.law.media_k * 2 * x / cell.healthy_m;
  }
  return out;
}

void push_wall(const PlaqueModel& model, int i, double a, PlaqueState& s) {
  const PlaqueCell& cell = model.cells[i];
  s.peak_m[i] = std::max(s.peak_m[i], a);
  if (a > s.rest_m[i]) {
    // Elastic up to the yield limit; the rest is permanent. Crack and hardening are taken at the beginning of the step,
    // which is accurate enough for small steps.
    const double elastic = yield_of(model, cell, s.broken[i], s.rest_m[i]) / cell.E_Pa * cell.healthy_m;
    if (const double given = a - s.rest_m[i] - elastic; given > 0) {
      const double before = opened(cell, s.rest_m[i]);
      s.rest_m[i] += given;
      if (cell.healthy_m - cell.diseased_m > 1e-9)
        s.broken[i] = std::min(1.0, s.broken[i] + (opened(cell, s.rest_m[i]) - before) / model.law.crack);
    }
  }
  s.radius_m[i] = std::max(a, s.rest_m[i]);
}

}  // namespace ostium::vascular
