/// Weight declared wrongly or not at all: `scale` times the declared weight; if almost nothing is declared, `scale`
/// times that of solid nitinol (6,450 kg/m3) with the instrument's cross-section.
#include "core/base/units.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace self_weight_parts {

constexpr double nitinol_kg_m3 = 6450, hardly_any_kg_m3 = 300;

std::string why_not(const MeasurementSet& set, std::optional<int>) {
  return set.gravity_m_s2.isZero() ? "there is no gravity" : "";
}

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, ExperimentSetup& setup) {
  for (std::size_t i = 0; i < setup.nest.parts.size(); ++i) {
    if (!chosen(effect.instrument, i)) continue;
    for (core::Section& s : setup.nest.parts[i].sections) {
      const double area = units::pi * (s.radius_m * s.radius_m - s.inner_radius_m * s.inner_radius_m);
      const double declared = s.kg_per_m < hardly_any_kg_m3 * area ? nitinol_kg_m3 * area : s.kg_per_m;
      s.kg_per_m = effect.values[0] * declared;
    }
  }
}

}  // namespace self_weight_parts

Effect self_weight() {
  using namespace self_weight_parts;
  Effect effect;
  effect.id = "self_weight";
  effect.what = "another weight than declared";
  effect.parameters = {{"scale", "1", "weight against what is declared", 1, 0.5, 0.02, 50, true}};
  effect.why_not = why_not, effect.apply = apply;
  effect.in_instrument = true;
  return effect;
}

}  // namespace ostium::data
