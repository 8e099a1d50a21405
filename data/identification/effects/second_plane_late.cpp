/// The second plane is exposed later than the first, and meanwhile the wire has been fed on: in the second view, and in
/// any further one, the insertion is longer by insertion_mm, in all experiments alike.
#include "core/base/units.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace second_plane_late_parts {

using units::mm;
constexpr double least_left_m = 2e-3;

std::string why_not(const MeasurementSet& set, std::optional<int>) {
  if (set.vessel) return "in a vessel each insertion is run once";
  return set.views.size() < 2 ? "the set has no second view" : "";
}

void apply(const ActiveEffect& effect, const MeasurementSet& set, const Experiment&, ExperimentSetup& setup) {
  if (setup.view == 0) return;
  for (std::size_t i = 0; i < setup.nest.parts.size(); ++i) {
    double& inserted = setup.nest.parts[i].inserted_m;
    inserted = std::clamp(inserted + effect.values[0] * mm, least_left_m, set.instruments[i].length_m);
  }
}

}  // namespace second_plane_late_parts

Effect second_plane_late() {
  using namespace second_plane_late_parts;
  Effect effect;
  effect.id = "second_plane_late";
  effect.what = "a second plane that comes later";
  effect.parameters = {{"insertion_mm", "mm", "insertion in the second view beyond the first", 0, 5, -60, 60, false}};
  effect.why_not = why_not, effect.apply = apply;
  effect.parts_views = true;
  effect.confused_with = "insertion_slip";
  return effect;
}

}  // namespace ostium::data
