#include "data/identification/selection/residual_fields.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/units.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace {

using Eigen::Vector3d;

using units::mm;

std::string always(const MeasurementSet&, std::optional<int>) { return ""; }

/// Interpolates values given at the knots, `width` numbers each, at `from_tip`.
double between_knots(const MeasurementSet& set, const std::vector<double>& v, int width, int component,
                     double from_tip) {
  const double at = std::clamp(from_tip / field_knot(set, 1), 0.0, field_knots - 1.0);
  const int k = std::min(static_cast<int>(at), field_knots - 2);
  const double t = at - k;
  return (1 - t) * v[width * k + component] + t * v[width * (k + 1) + component];
}

void bend(const ActiveEffect& field, const MeasurementSet& set, const Experiment&, ExperimentSetup& setup) {
  constexpr int pieces = 3 * (field_knots - 1);
  const double length = field_knot(set, field_knots - 1);
  for (int k = 0; k < pieces; ++k) {
    const double from = k * length / pieces, to = k + 1 == pieces ? 1e3 : (k + 1) * length / pieces;
    const double middle = (k + 0.5) * length / pieces;
    const Eigen::Vector2d add(between_knots(set, field.values, 2, 0, middle),
                              between_knots(set, field.values, 2, 1, middle));
    change_stretch(setup.nest.parts.back().sections, from, to,
                   [&](core::Section& s) { s.rest_curvature_per_m.head<2>() += add; });
  }
}

void press(const ActiveEffect& field, const MeasurementSet& set, const Experiment&, ExperimentSetup& setup) {
  const double inserted = setup.nest.parts.back().inserted_m, spacing = field_knot(set, 1) / 4;
  const int count = static_cast<int>(std::ceil(inserted / spacing));
  for (int i = 0; i < count; ++i) {
    const double from_tip = (i + 0.5) * inserted / count;
    Vector3d force;
    for (int c = 0; c < 3; ++c) force[c] = between_knots(set, field.values, 3, c, from_tip) * inserted / count;
    setup.nest.loads.push_back({inserted - from_tip, force});
  }
}

Eigen::Matrix3d turn_of(const Vector3d& turn) {
  return turn.norm() > 0 ? Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix()
                         : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
}

void distort(const ActiveEffect& field, const MeasurementSet& set, const Experiment&, MeasuredView& view) {
  const Vector3d about = set.experiments[0].base.p_W;
  const Eigen::Matrix3d A =
      Eigen::Matrix3d::Identity() +
      Eigen::Matrix3d(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(field.values.data()));
  const Vector3d shift = Vector3d(field.values[9], field.values[10], field.values[11]) * mm;
  view.b_m = A * (view.b_m - about) + about + shift;
  view.A = A * view.A;
}

/// 0 to 1 from the first experiment to the last, or from the shortest time in position to the longest; at 0 everything
/// is as declared.
double time_of(const MeasurementSet& set, const Experiment& e) {
  double least = 1e300, most = -1e300;
  for (const Experiment& x : set.experiments)
    if (x.elapsed_s) least = std::min(least, std::log1p(*x.elapsed_s)), most = std::max(most, std::log1p(*x.elapsed_s));
  if (most > least) return (std::log1p(e.elapsed_s.value_or(0)) - least) / (most - least);
  const auto n = static_cast<double>(set.experiments.size());
  return n > 1 ? static_cast<double>(&e - set.experiments.data()) / (n - 1) : 0;
}

void drift(const ActiveEffect& field, const MeasurementSet& set, const Experiment& e, ExperimentSetup& setup) {
  const double t = time_of(set, e);
  const auto& v = field.values;
  for (core::ConcentricPart& part : setup.nest.parts)
    for (core::Section& s : part.sections) {
      s.rest_curvature_per_m *= std::max(1 + t * v[0], 0.0);
      s.rest_curvature_per_m.head<2>() += t * Eigen::Vector2d(v[1], v[2]);
      const double stiffer = std::exp(std::clamp(t * v[3], -2.0, 2.0));
      s.EI1_N_m2 *= stiffer, s.EI2_N_m2 *= stiffer, s.GJ_N_m2 *= stiffer;
    }
}

void drift_seen(const ActiveEffect& field, const MeasurementSet& set, const Experiment& e, MeasuredView& view) {
  const double t = time_of(set, e);
  const auto& v = field.values;
  const Vector3d about = set.experiments[0].base.p_W;
  const Eigen::Matrix3d R = turn_of(t * Vector3d(v[4], v[5], v[6]));
  view.b_m = R * (view.b_m - about) + about + t * Vector3d(v[7], v[8], v[9]) * mm;
  view.A = R * view.A;
}

void scale_forces(const MeasurementSet& set, std::optional<int>, std::vector<EffectParameter>& p) {
  // Scaled to a visible bending: EI / L^3.
  const double length = longest_inserted(set, {});
  double EI = 0;
  for (const MeasuredInstrument& i : set.instruments) EI = std::max(EI, i.sections.back().EI1_N_m2);
  for (EffectParameter& q : p) q.spread = EI / (length * length * length);
}
void scale_curvatures(const MeasurementSet& set, std::optional<int>, std::vector<EffectParameter>& p) {
  for (EffectParameter& q : p) q.spread = 0.5 / longest_inserted(set, {});
}

Effect numbered(const std::string& id, const std::string& what, int count, double spread, double most) {
  Effect field;
  field.id = id, field.what = what, field.why_not = always;
  for (int i = 0; i < count; ++i)
    field.parameters.push_back({std::to_string(i), "1", what, 0, spread, -most, most, false});
  return field;
}

}  // namespace

double field_knot(const MeasurementSet& set, int knot) {
  return knot * longest_inserted(set, static_cast<int>(set.instruments.size()) - 1) / (field_knots - 1);
}

const Effect& rest_curvature_field() {
  static const Effect field = [] {
    Effect f = numbered("field of rest curvature", "rest curvature at a knot, 1/m", 2 * field_knots, 1, 1e4);
    f.apply = bend, f.adapt = scale_curvatures;
    return f;
  }();
  return field;
}

const Effect& lateral_force_field() {
  static const Effect field = [] {
    Effect f = numbered("field of force", "force per length at a knot, N/m", 3 * field_knots, 1, 1e4);
    f.apply = press, f.adapt = scale_forces;
    return f;
  }();
  return field;
}

const Effect& image_field() {
  static const Effect field = [] {
    Effect f = numbered("error of the picture", "of the picture", 12, 0.02, 1e3);
    for (int i = 9; i < 12; ++i) f.parameters[i].spread = 2;
    for (int i = 0; i < 9; ++i) f.parameters[i].most = 0.5, f.parameters[i].least = -0.5;
    f.see = distort;
    return f;
  }();
  return field;
}

const Effect& time_field() {
  static const Effect field = [] {
    Effect f = numbered("change with time", "over the time of the set", 10, 0.1, 1e3);
    for (int i : {1, 2}) f.parameters[i].spread = 0.5;
    for (int i : {4, 5, 6}) f.parameters[i].spread = 0.02;
    for (int i : {7, 8, 9}) f.parameters[i].spread = 2;
    f.apply = drift, f.see = drift_seen;
    return f;
  }();
  return field;
}

}  // namespace ostium::data
