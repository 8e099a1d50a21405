#include "vascular/physiology/awareness.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"

namespace ostium::vascular {

namespace {

using units::mmHg;

constexpr double silent = 2;  // no W reaches it
constexpr double span = 0.2;  // of W, from the first pain to the worst
constexpr double venous_Pa = 10 * mmHg, needs_Pa = 50 * mmHg, enough = 0.6, most = 1.2;
constexpr double faints_at = 0.3, wakes_at = 0.6;

}  // namespace

AwarenessModel awareness_of(std::uint64_t seed) {
  AwarenessModel model;
  if (seed == 0) return model;
  const double u = core::uniform(seed, 62, 0);
  model.threshold = u < 1.0 / 3 ? silent : 0.02 + 0.18 * (u - 1.0 / 3) * 1.5;
  return model;
}

void step(const AwarenessModel& model, const IschaemiaState& ischaemia, double mean_Pa, double dt, AwarenessState& s) {
  double lacking = 0;
  for (std::size_t i = 0; i < territories; ++i) lacking += left_share[i] * ischaemia.late[i];
  const double x = std::clamp((lacking - model.threshold) / span, 0.0, 1.0);
  s.pain += -std::expm1(-dt / model.pain_s) * (10 * x * x * (3 - 2 * x) - s.pain);
  const double supplied = std::min(most, std::max(0.0, mean_Pa - venous_Pa) / needs_Pa);
  s.oxygen = std::clamp(s.oxygen + dt * (supplied - enough) / model.store_s, 0.0, 1.0);
  if (s.oxygen < faints_at) s.awake = false;
  if (s.oxygen > wakes_at) s.awake = true;
}

}  // namespace ostium::vascular
