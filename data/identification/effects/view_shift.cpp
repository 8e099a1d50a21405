/// A picture is shifted on its detector: cropped, or the detector is not where it is declared. Columns and rows of a
/// view are off by as many pixels everywhere.
#include "data/identification/effects/view_tools.h"

namespace ostium::data {

namespace view_shift_parts {

void see(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, MeasuredView& view) {
  for (std::size_t v = 0; v < view.cameras.size(); ++v)
    if (in_view(effect, v)) view.cameras[v].shift_px += Eigen::Vector2d(effect.values[1], effect.values[2]);
}

std::vector<EffectForm> forms(const MeasurementSet& set, std::optional<int>) { return forms_of_views(set, false); }

}  // namespace view_shift_parts

Effect view_shift() {
  using namespace view_shift_parts;
  Effect effect;
  effect.id = "view_shift";
  effect.what = "a picture that is shifted";
  effect.parameters = {view_parameter(),
                       {"columns_px", "px", "shift towards higher columns", 0, 10, -500, 500, false},
                       {"rows_px", "px", "shift towards higher rows", 0, 10, -500, 500, false}};
  effect.why_not = no_views, effect.see = see, effect.forms = forms;
  return effect;
}

}  // namespace ostium::data
