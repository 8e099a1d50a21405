/// The moment-curvature curve as the data show it, the same there and back (bending_law.h): whatever form it has.
#include "data/identification/curves/three_point_bend/three_point_bend.h"
#include "data/identification/effects/bending_law.h"

namespace ostium::data::three_point_bend {

namespace {

core::BendingCurve curve_of(const std::vector<double>& v) {
  return bending_law::curve_of(std::span(v).subspan(1), v[0] / 1e-3);
}

}  // namespace

Effect law_bending() {
  Effect effect;
  effect.head.id = "law:bending";
  effect.head.what = "bending as the data show it";
  effect.head.parameters = {{"reach_per_mm", "1/mm", "largest curvature of the law", 0.05, 0, 1e-5, 10, false}};
  for (int j = 1; j <= bending_law::knots; ++j)
    effect.head.parameters.push_back({"step_" + std::to_string(j), "1", "of ln(tangent stiffness), from knot to knot",
                                      0, bending_law::step_spread, -bending_law::most_step, bending_law::most_step,
                                      false});
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.section.bending = curve_of(v); };
  effect.adapt = [](const Setup& declared, std::vector<EffectParameter>& p) {
    p[0].prior = largest_curvature_per_m(declared) * 1e-3;
  };
  effect.head.law = [](const std::vector<double>& v, std::span<const double> free) {
    const core::BendingCurve curve = curve_of(v);
    return bending_law::table(
        "law:bending", free[0], v[0] / 1e-3, [&](double k) { return curve.moment_per_m(k); },
        [](double) { return bending_law::too_fine(); });
  };
  return effect;
}

}  // namespace ostium::data::three_point_bend
