/// S-distortion, as where the earth's magnetic field turns the electrons of an image intensifier the more the farther
/// out they are: with r the distance from the picture's middle over half its width, points turn about the middle by
/// turn_deg r2, so that lines through it become an S (Gronenschild 1997, Med Phys 24:1875).
#include "core/base/units.h"
#include "data/identification/effects/view_tools.h"

namespace ostium::data {

namespace s_distortion_parts {

void see(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, MeasuredView& view) {
  for (std::size_t v = 0; v < view.cameras.size(); ++v)
    if (in_view(effect, v)) view.cameras[v].s_turn_rad += effect.values[1] * units::degree;
}

std::vector<EffectForm> forms(const MeasurementSet& set, std::optional<int>) { return forms_of_views(set, true); }

}  // namespace s_distortion_parts

Effect s_distortion() {
  using namespace s_distortion_parts;
  Effect effect;
  effect.id = "s_distortion";
  effect.what = "S-distortion";
  effect.parameters = {
      view_parameter(),
      {"turn_deg", "deg", "turn at half the picture's width, from columns to rows", 0, 1.5, -20, 20, false}};
  effect.why_not = no_views, effect.see = see, effect.forms = forms;
  return effect;
}

}  // namespace ostium::data
