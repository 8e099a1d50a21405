#include "data/identification/forward/projected.h"

#include "data/identification/forward/curve.h"

namespace ostium::data {

namespace {

std::vector<Eigen::Vector3d> in_plane(const std::vector<Eigen::Vector2d>& points) {
  std::vector<Eigen::Vector3d> out;
  for (const Eigen::Vector2d& p : points) out.emplace_back(p.x(), p.y(), 0);
  return out;
}

}  // namespace

std::vector<Eigen::Vector2d> projected_px(const PredictedShape& shape, const MeasuredView& view, int of_view) {
  const bool later = of_view > 0 && !shape.later_views_m.empty();
  std::vector<Eigen::Vector2d> out;
  for (const Eigen::Vector3d& p : later ? shape.later_views_m[of_view - 1] : shape.points_m)
    out.push_back(view.cameras[of_view](view(p)));
  return out;
}

Eigen::VectorXd projected_misfit(const Experiment& e, const PredictedShape& shape, const MeasuredView& view) {
  Eigen::VectorXd off(3 * clicked_points(e));
  Eigen::Index at = 0;
  for (const ClickedPolyline& polyline : e.polylines) {
    const Camera& camera = view.cameras[polyline.view];
    const std::vector<Eigen::Vector3d> clicked = in_plane(polyline.points_px);
    const std::vector<Eigen::Vector3d> nearest =
        nearest_points(in_plane(projected_px(shape, view, polyline.view)), clicked);
    for (std::size_t i = 0; i < clicked.size(); ++i, at += 3) {
      const Eigen::Vector3d px = clicked[i] - nearest[i];
      off.segment<3>(at) = px.x() * camera.u + px.y() * camera.v;
    }
  }
  return off;
}

std::size_t clicked_points(const Experiment& e) {
  std::size_t count = 0;
  for (const ClickedPolyline& polyline : e.polylines) count += polyline.points_px.size();
  return count;
}

}  // namespace ostium::data
