/// Bending stiffness that differs between two axes across the instrument: a flattened core, a tube with a seam.
/// EI1 = EI sqrt(ratio), EI2 = EI / sqrt(ratio) about axes that lie `axis_deg` from d1 and d2, right-handed about d3.
/// Everywhere, or from `from_tip_mm` to `to_tip_mm`, where the tip is flattened otherwise than the shaft. Law: the
/// rod's own (Kirchhoff's, with two stiffnesses). For an instrument alone.
#include <Eigen/Geometry>
#include <cmath>

#include "core/base/units.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace bending_anisotropy_parts {

std::string why_not(const MeasurementSet& set, std::optional<int>) {
  return set.instruments.size() > 1 ? "nested instruments are modelled with one bending stiffness" : "";
}

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, ExperimentSetup& setup) {
  const double root = std::sqrt(effect.values[0]), axis = effect.values[1] * units::pi / 180;
  core::ConcentricPart& part = setup.nest.parts[0];
  change_stretch(part.sections, effect.values[2] * units::mm, effect.values[3] * units::mm,
                 [root](core::Section& s) { s.EI1_N_m2 *= root, s.EI2_N_m2 /= root; });
  for (core::Section& s : part.sections)
    s.rest_curvature_per_m.head<2>() = Eigen::Rotation2Dd(-axis) * Eigen::Vector2d(s.rest_curvature_per_m.head<2>());
  part.roll_rad += axis;
  setup.material_turn_rad += axis;
}

/// Along the directors or across them; in one section along them, as of the whole and a section the axes are one.
std::vector<EffectForm> forms(const MeasurementSet& set, std::optional<int> instrument) {
  std::vector<EffectForm> out;
  for (EffectForm form : stretches_of(set, instrument)) {
    const bool whole = form.name.empty();
    if (whole) out.push_back({"oblique", form.held});
    form.name = whole ? "about d1 and d2" : form.name;
    form.held.emplace_back("axis_deg", 0);
    out.push_back(form);
  }
  return out;
}

}  // namespace bending_anisotropy_parts

Effect bending_anisotropy() {
  using namespace bending_anisotropy_parts;
  Effect effect;
  effect.id = "bending_anisotropy";
  effect.what = "bending stiffness that differs between two axes";
  effect.parameters = {{"ratio", "1", "EI about the first axis against the second", 1, 0.4, 0.1, 10, true},
                       {"axis_deg", "deg", "from d1 to the first axis", 0, 25, -60, 60, false},
                       {"from_tip_mm", "mm", "where it begins, from the tip", 0, 1, 0, everywhere_mm, false},
                       {"to_tip_mm", "mm", "where it ends, from the tip", everywhere_mm, 1, 0, everywhere_mm, false}};
  effect.why_not = why_not, effect.apply = apply, effect.forms = forms;
  effect.in_instrument = true;
  effect.of_several_stretches = true;
  return effect;
}

}  // namespace ostium::data
