/// A C-arm's angles are not those that are written down: source and detector of a view turn together about the
/// isocentre, by primary_deg about the patient's long axis (the frame's z) and by secondary_deg about the horizontal
/// axis across it (DICOM PS3.3 C.8.7.5, positioner angles). The isocentre is where the views' central rays meet.
#include "core/base/units.h"
#include "data/identification/effects/view_tools.h"

namespace ostium::data {

namespace view_angle_parts {

using units::degree;

void see(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, MeasuredView& view) {
  const Eigen::Vector3d centre = isocentre_m(view.cameras);
  const GantryAngles more{effect.values[1] * degree, effect.values[2] * degree};
  for (std::size_t v = 0; v < view.cameras.size(); ++v)
    if (in_view(effect, v))
      turn_about(view.cameras[v], centre, gantry_turn(gantry_angles(view.cameras[v].outwards()), more));
}

std::vector<EffectForm> forms(const MeasurementSet& set, std::optional<int>) { return forms_of_views(set, false); }

}  // namespace view_angle_parts

Effect view_angle() {
  using namespace view_angle_parts;
  Effect effect;
  effect.id = "view_angle";
  effect.what = "a C-arm's angle that is off";
  effect.parameters = {view_parameter(),
                       {"primary_deg", "deg", "primary angle beyond the declared", 0, 2, -45, 45, false},
                       {"secondary_deg", "deg", "secondary angle beyond the declared", 0, 2, -45, 45, false}};
  effect.why_not = no_views, effect.see = see, effect.forms = forms;
  return effect;
}

}  // namespace ostium::data
