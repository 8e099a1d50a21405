#include "data/identification/forward/misfit.h"

#include <cmath>

#include "data/identification/forward/curve.h"
#include "data/identification/forward/projected.h"

namespace ostium::data {

MeasuredView seen(const MeasurementSet& set, const Experiment& experiment, const Changes& changes, MeasuredView view) {
  for (const MeasuredCArm& arm : set.views) view.cameras.push_back(arm.camera);
  for (const ActiveEffect& active : changes.effects)
    if (active.effect->see) active.effect->see(active, set, experiment, view);
  return view;
}

Eigen::Vector3d tracked_tip(const PredictedShape& shape, const MeasuredView& view) {
  const Eigen::Vector4d& q = shape.tip_q;
  return view(shape.points_m.back() + Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * view.tip_offset_m);
}

Eigen::VectorXd misfit(const Experiment& e, const PredictedShape& shape, const MeasuredView& view) {
  if (e.kind == Experiment::Kind::radius)
    return Eigen::VectorXd::Constant(
        1, e.radius_m - std::cbrt(view.A.determinant()) * radius_of_curvature(shape.points_m));
  if (e.kind == Experiment::Kind::tip) return e.points_m[0] - tracked_tip(shape, view);
  if (e.kind == Experiment::Kind::projections) return projected_misfit(e, shape, view);
  Eigen::VectorXd off(3 * e.points_m.size());
  const Eigen::Matrix3d back = view.A.inverse();
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& p : e.points_m) points.push_back(view.R.conjugate() * (back * (p - view.b_m) - view.t_m));
  const std::vector<Eigen::Vector3d> nearest = nearest_points(shape.points_m, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    off.segment<3>(3 * static_cast<Eigen::Index>(i)) = view.A * (view.R * (points[i] - nearest[i]));
  return off;
}

std::size_t distances(const Experiment& e) {
  switch (e.kind) {
    case Experiment::Kind::radius:
      return 1;
    case Experiment::Kind::projections:
      return clicked_points(e);
    default:
      return e.points_m.size();
  }
}

std::size_t numbers_measured(const Experiment& e) {
  switch (e.kind) {
    case Experiment::Kind::centreline:
      return 2 * e.points_m.size();
    case Experiment::Kind::projections:
      return clicked_points(e);
    case Experiment::Kind::tip:
      return 3;
    default:
      return 1;
  }
}

double rms(const std::vector<const Experiment*>& experiments, const std::vector<Eigen::VectorXd>& misfits) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    sum += misfits[i].squaredNorm();
    count += static_cast<double>(distances(*experiments[i]));
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

std::size_t misfit_rows(const Experiment& e) { return e.kind == Experiment::Kind::radius ? 1 : 3 * distances(e); }

double noise_floor(const MeasurementSet& set, double sigma_m) {
  double numbers = 0, count = 0;
  for (const Experiment& e : set.experiments)
    numbers += static_cast<double>(numbers_measured(e)), count += static_cast<double>(distances(e));
  return sigma_m * std::sqrt(numbers / std::max(count, 1.0));
}

double rms(const MeasurementSet& set, const std::vector<Eigen::VectorXd>& misfits) {
  std::vector<const Experiment*> all;
  for (const Experiment& e : set.experiments) all.push_back(&e);
  return rms(all, misfits);
}

}  // namespace ostium::data
