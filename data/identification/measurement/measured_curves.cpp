#include "data/identification/measurement/measured_curves.h"

namespace ostium::data {

namespace {

/// Distances of points from the last one along their polyline, in the points' unit.
template <class Points>
std::vector<double> from_last(const Points& points) {
  std::vector<double> out(points.size(), 0);
  for (std::size_t i = points.size() - 1; i-- > 0;) out[i] = out[i + 1] + (points[i + 1] - points[i]).norm();
  return out;
}

}  // namespace

std::vector<MeasuredCurve> measured_curves(const Experiment& e) {
  if (e.kind == Experiment::Kind::centreline) return {{0, 0, from_last(e.points_m)}};
  std::vector<MeasuredCurve> out;
  std::size_t first = 0;
  for (const ClickedPolyline& polyline : e.polylines) {
    std::vector<double> from_tip = from_last(polyline.points_px);
    const double seen_px = from_tip.front();
    for (double& s : from_tip) s *= seen_px > 0 ? e.set.back().inserted_m / seen_px : 0;
    out.push_back({first, polyline.view, std::move(from_tip)});
    first += polyline.points_px.size();
  }
  return out;
}

}  // namespace ostium::data
