/// Image magnification error: measured = c + scale (true - c), where c is the origin of the measuring frame
/// (`about_base` 0) or the first base (1).
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace imaging_scale_parts {

std::string why_not(const MeasurementSet&, std::optional<int>) { return ""; }

/// Also scales measured radii, which no frame shifts: see `misfit`.
void see(const ActiveEffect& effect, const MeasurementSet& set, const Experiment&, MeasuredView& view) {
  const double scale = effect.values[0];
  const Eigen::Vector3d about = effect.values[1] * set.experiments[0].base.p_W;
  view.b_m = scale * (view.b_m - about) + about;
  view.A *= scale;
}

std::vector<EffectForm> forms(const MeasurementSet& set, std::optional<int>) {
  if (set.imaging.registration_free || set.experiments[0].base.p_W.norm() < 1e-6) return {{"", {{"about_base", 0}}}};
  return {{"about the origin", {{"about_base", 0}}}, {"about the base", {{"about_base", 1}}}};
}

}  // namespace imaging_scale_parts

Effect imaging_scale() {
  using namespace imaging_scale_parts;
  Effect effect;
  effect.id = "imaging_scale";
  effect.what = "a wrong scale of the picture";
  effect.parameters = {{"scale", "1", "measured lengths against true ones", 1, 0.05, 0.5, 2, false},
                       {"about_base", "1", "what stays in place: 0 the origin, 1 the first base", 0, 1, 0, 1, false}};
  effect.why_not = why_not, effect.see = see, effect.forms = forms;
  return effect;
}

}  // namespace ostium::data
