#include "data/identification/forward/shape.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/units.h"

namespace ostium::data {

namespace {

using Eigen::Vector3d;

/// The largest change per step when walking from one experiment to the next.
constexpr double step_insertion_m = 10e-3, step_turn_rad = 20 * units::pi / 180;
constexpr int most_steps = 100;

/// Drives, base and loads interpolated between `a` and `b` at t in [0, 1].
ExperimentSetup between(const ExperimentSetup& a, const ExperimentSetup& b, double t) {
  ExperimentSetup s = b;
  for (std::size_t i = 0; i < s.nest.parts.size(); ++i) {
    const core::ConcentricPart &from = a.nest.parts[i], &to = b.nest.parts[i];
    s.nest.parts[i].inserted_m = (1 - t) * from.inserted_m + t * to.inserted_m;
    s.nest.parts[i].roll_rad = (1 - t) * from.roll_rad + t * to.roll_rad;
    s.nest.parts[i].shaft_rad_per_Nm = (1 - t) * from.shaft_rad_per_Nm + t * to.shaft_rad_per_Nm;
  }
  s.base.p_W = (1 - t) * a.base.p_W + t * b.base.p_W;
  const Eigen::Quaterniond q = quaternion(a.base.q_W).slerp(t, quaternion(b.base.q_W));
  s.base.q_W = {q.w(), q.x(), q.y(), q.z()};
  s.tip_force_N = (1 - t) * a.tip_force_N + t * b.tip_force_N;
  s.nest.element_lengths_m = concentric_elements(s.nest.parts, 3e-3, 0.15);  // intermediate shapes may be coarser
  return s;
}

int steps_between(const ExperimentSetup& a, const ExperimentSetup& b) {
  double steps = quaternion(a.base.q_W).angularDistance(quaternion(b.base.q_W)) / step_turn_rad;
  for (std::size_t i = 0; i < a.nest.parts.size(); ++i) {
    const core::ConcentricPart &from = a.nest.parts[i], &to = b.nest.parts[i];
    steps = std::max({steps, std::fabs(to.inserted_m - from.inserted_m) / step_insertion_m,
                      std::fabs(to.roll_rad - from.roll_rad) / step_turn_rad});
  }
  const double load = (b.tip_force_N - a.tip_force_N).norm(),
               most = std::max(a.tip_force_N.norm(), b.tip_force_N.norm());
  if (most > 0) steps = std::max(steps, 4 * load / most);
  return std::clamp(static_cast<int>(std::ceil(steps - 1e-9)), 1, most_steps);
}

StaticEquilibrium settled(const ExperimentSetup& setup, const StaticEquilibrium* before) {
  StaticEquilibrium anchor{make_concentric(setup.nest, setup.gravity_m_s2), {}, false};
  anchor.state = before ? carried_over(anchor.nest, setup.base, before->nest, before->state)
                        : straight_state(anchor.nest, setup.base);
  anchor.converged = find_equilibrium(anchor.nest, setup.base, setup.tip_force_N, anchor.state).converged;
  return anchor;
}

/// Compares element lengths, not only their number: a state depends on them.
bool same_elements(const core::Concentric& a, const core::Concentric& b) {
  const core::Rod &x = a.carrier.rods[0], &y = b.carrier.rods[0];
  if (x.elements != y.elements) return false;
  for (int j = 0; j < x.elements; ++j)
    if (x.length.at(0)[j] != y.length.at(0)[j]) return false;
  return true;
}

/// Points up to `length` along the curve.
std::vector<Vector3d> cut_at(const std::vector<Vector3d>& points, double length) {
  std::vector<Vector3d> out = {points.front()};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double piece = (points[i] - points[i - 1]).norm();
    if (piece >= length - 1e-9) {
      out.push_back(points[i - 1] + length / piece * (points[i] - points[i - 1]));
      break;
    }
    out.push_back(points[i]);
    length -= piece;
  }
  return out;
}

}  // namespace

PredictedShape shape_from(const ExperimentSetup& setup, const StaticEquilibrium& anchor) {
  StaticEquilibrium end;
  return shape_from(setup, anchor, end);
}

PredictedShape shape_from(const ExperimentSetup& setup, const StaticEquilibrium& anchor, StaticEquilibrium& end) {
  end.nest = make_concentric(setup.nest, setup.gravity_m_s2);
  const core::Concentric& nest = end.nest;
  core::ConcentricState& state = end.state =
      same_elements(nest, anchor.nest) ? anchor.state : carried_over(nest, setup.base, anchor.nest, anchor.state);
  const core::ConcentricEquilibrium found = find_equilibrium(nest, setup.base, setup.tip_force_N, state);
  end.converged = found.converged;
  PredictedShape shape;
  shape.converged = found.converged;
  shape.base_push_N = found.base_push_N;
  const core::RodState& rod = state.carrier.rods[0];
  for (int i = 0; i < rod.position.size(); ++i) shape.points_m.push_back(rod.position[i]);
  shape.points_m = cut_at(shape.points_m, setup.nest.parts.back().inserted_m);
  const Eigen::Quaterniond tip = quaternion(tip_frame(nest, state, static_cast<int>(setup.nest.parts.size()) - 1)) *
                                 Eigen::AngleAxisd(-setup.material_turn_rad, Vector3d::UnitZ());
  shape.tip_q = {tip.w(), tip.x(), tip.y(), tip.z()};
  return shape;
}

void add_later_views(const MeasurementSet& set, const Experiment& e, const Changes& changes, double longest_element_m,
                     const StaticEquilibrium& anchor, PredictedShape& shape) {
  if (std::none_of(changes.effects.begin(), changes.effects.end(),
                   [](const ActiveEffect& active) { return active.effect->parts_views; }))
    return;
  for (std::size_t v = 1; v < set.views.size(); ++v) {
    const PredictedShape seen = shape_from(setup_of(set, e, changes, longest_element_m, static_cast<int>(v)), anchor);
    shape.converged = shape.converged && seen.converged;
    shape.later_views_m.push_back(seen.points_m);
  }
}

std::vector<StaticEquilibrium> walk(const MeasurementSet& set, const Changes& changes,
                                    const std::function<void(std::size_t, std::size_t)>& progress,
                                    double longest_element_m) {
  std::vector<StaticEquilibrium> anchors;
  std::optional<ExperimentSetup> before;
  for (const Experiment& e : set.experiments) {
    const ExperimentSetup setup = setup_of(set, e, changes, longest_element_m);
    std::optional<StaticEquilibrium> on_the_way;
    if (before && anchors.back().converged) {
      on_the_way = anchors.back();
      const int steps = steps_between(*before, setup);
      for (int k = 1; k < steps && on_the_way->converged; ++k)
        on_the_way = settled(between(*before, setup, static_cast<double>(k) / steps), &*on_the_way);
      if (!on_the_way->converged) on_the_way = anchors.back();
    }
    anchors.push_back(settled(setup, on_the_way ? &*on_the_way : nullptr));
    if (!anchors.back().converged) anchors.back() = settled(setup, nullptr);
    before = setup;
    if (progress) progress(anchors.size(), set.experiments.size());
  }
  return anchors;
}

}  // namespace ostium::data
