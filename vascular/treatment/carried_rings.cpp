#include "vascular/treatment/carried_rings.h"

#include <algorithm>
#include <cmath>

namespace ostium::vascular {

namespace {

constexpr double touches_m = 1e-6;

/// How far each ring goes along: what lies round a balloon's cylinder with it, the rest not at all.
double carried_m(const StentModel& m, const PlaqueModel& plaque, const StentInputs& in, const PlaqueState& wall,
                 const StentState& s, int ring) {
  const double at_m = ring_middle_m(m, s, ring), r = s.radius_m[static_cast<std::size_t>(ring)];
  const int cell = in.path->cells[static_cast<std::size_t>(in.path->at(at_m).index)];
  if (wall_pressure(plaque, wall, cell, r + m.strut_m).p_Pa > 0) return 0;
  for (const BalloonInside& balloon : in.inside) {
    if (at_m > balloon.to_m || std::fabs(at_m - balloon.state->seat_m) > balloon.model->length_m / 2) continue;
    if (radius_at(*balloon.model, *balloon.state, at_m) >= r - touches_m) return balloon.slid_m;
  }
  return 0;
}

}  // namespace

void carry_rings(const StentModel& m, const PlaqueModel& plaque, const StentInputs& in, const PlaqueState& wall,
                 StentState& s) {
  const auto slides = [](const BalloonInside& balloon) { return balloon.slid_m != 0; };
  if (!in.path || std::none_of(in.inside.begin(), in.inside.end(), slides)) return;
  const int around = 2 * m.crowns;
  const double least_m = m.pressed_together * m.pitch_m();
  double before_m = 0;
  for (int k = 0; k < m.rings; ++k) {
    const double along_m = carried_m(m, plaque, in, wall, s, k);
    for (int j = 0; j < around; ++j) s.along_m[static_cast<std::size_t>(k * around + j)] += along_m;
    if (k > 0) {
      double& link_m = s.link_m[static_cast<std::size_t>(k - 1)];
      link_m = std::max(std::min(least_m, link_m), link_m + along_m - before_m);
    }
    before_m = along_m;
  }
}

}  // namespace ostium::vascular
