/// Source or detector is farther than declared: by source_mm the source moves away from the detector along its normal,
/// by detector_mm the detector away from the source. Either changes how much is magnified, M = SID / depth, and the
/// first also how that goes with the depth.
#include "core/base/units.h"
#include "data/identification/effects/view_tools.h"

namespace ostium::data {

namespace source_distance_parts {

using units::mm;

void see(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, MeasuredView& view) {
  for (std::size_t v = 0; v < view.cameras.size(); ++v) {
    Camera& camera = view.cameras[v];
    if (!in_view(effect, v)) continue;
    const Eigen::Vector3d outwards = camera.outwards();
    camera.source_m -= effect.values[1] * mm * outwards;
    camera.pixel_0_0_m += effect.values[2] * mm * outwards;
  }
}

std::vector<EffectForm> forms(const MeasurementSet& set, std::optional<int>) {
  std::vector<EffectForm> out = forms_of_views(set, true, {{"source_mm", 0}}, "detector");
  for (const EffectForm& form : forms_of_views(set, true, {{"detector_mm", 0}}, "source")) out.push_back(form);
  return out;
}

}  // namespace source_distance_parts

Effect source_distance() {
  using namespace source_distance_parts;
  Effect effect;
  effect.id = "source_distance";
  effect.what = "another distance of source and detector";
  effect.parameters = {view_parameter(),
                       {"source_mm", "mm", "source farther from the detector", 0, 30, -400, 1000, false},
                       {"detector_mm", "mm", "detector farther from the source", 0, 30, -400, 1000, false}};
  effect.why_not = no_views, effect.see = see, effect.forms = forms;
  effect.confused_with = "imaging_scale";
  return effect;
}

}  // namespace ostium::data
