/// Pincushion distortion, as of an image intensifier's curved input screen: with r the distance from the picture's
/// middle over half its width, radii grow by the factor 1 + k r2 (Gronenschild 1997, Med Phys 24:1875).
#include "data/identification/effects/view_tools.h"

namespace ostium::data {

namespace pincushion_parts {

void see(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, MeasuredView& view) {
  for (std::size_t v = 0; v < view.cameras.size(); ++v)
    if (in_view(effect, v)) view.cameras[v].pincushion += effect.values[1];
}

std::vector<EffectForm> forms(const MeasurementSet& set, std::optional<int>) { return forms_of_views(set, true); }

}  // namespace pincushion_parts

Effect pincushion() {
  using namespace pincushion_parts;
  Effect effect;
  effect.id = "pincushion";
  effect.what = "pincushion distortion";
  effect.parameters = {view_parameter(),
                       {"k", "1", "growth of radii at half the picture's width", 0, 0.03, -0.3, 0.3, false}};
  effect.why_not = no_views, effect.see = see, effect.forms = forms;
  return effect;
}

}  // namespace ostium::data
