#include "app/session/coupling/tool_geometry.h"

#include <algorithm>
#include <functional>

namespace ostium::app {

using Eigen::Vector3d;

Vector3d direction_at_tip(const core::Rod& rod, const core::RodState& s) {
  return (s.position[rod.elements] - s.position[rod.elements - 2]).normalized();
}

double marker_from_tip_m(const data::Instrument& instrument, int which) {
  const std::vector<data::Marker>& m = instrument.markers;
  const double a = m[0].from_tip_m + m[0].length_m / 2, b = m[1].from_tip_m + m[1].length_m / 2;
  return which == 0 ? std::max(a, b) : std::min(a, b);
}

Vector3d point_from_tip(const core::Rod& rod, const core::RodState& s, double from_tip_m) {
  if (from_tip_m >= s.inserted_m) return s.base.p_W;
  const std::vector<double>& from_tip = rod.node_from_tip_m;
  // The first node that is not farther; its number is at least 1.
  const auto at = std::lower_bound(from_tip.begin() + 1, from_tip.end() - 1, from_tip_m, std::greater<>());
  const auto i = static_cast<int>(at - from_tip.begin());
  if (i <= s.first) return s.base.p_W;
  const double length = from_tip[static_cast<std::size_t>(i) - 1] - from_tip[static_cast<std::size_t>(i)];
  const double part = (from_tip_m - from_tip[static_cast<std::size_t>(i)]) / length;
  return s.position[i] + part * (s.position[i - 1] - s.position[i]);
}

}  // namespace ostium::app
