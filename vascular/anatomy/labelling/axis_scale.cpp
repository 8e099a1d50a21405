#include "vascular/anatomy/labelling/axis_scale.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostium::vascular {

namespace {

constexpr double matters = 0.85;
constexpr std::size_t looked_at = 8000;  // vertices

struct Place {
  Eigen::Vector3d p, along;
  double radius_m;
};

std::vector<Place> places_of(const std::vector<Tube>& tubes) {
  std::vector<Place> out;
  for (const Tube& tube : tubes)
    for (std::size_t i = 0; i < tube.nodes.size(); ++i) {
      const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, tube.nodes.size() - 1);
      const Eigen::Vector3d along = tube.nodes[after].p - tube.nodes[before].p;
      if (along.norm() > 0) out.push_back({tube.nodes[i].p, along.normalized(), tube.nodes[i].radius_m});
    }
  return out;
}

/// By distances in radii.
const Place& nearest(const std::vector<Place>& places, const Eigen::Vector3d& p) {
  const auto far = [&](const Place& place) { return (p - place.p).squaredNorm() / (place.radius_m * place.radius_m); };
  return *std::ranges::min_element(places, {}, far);
}

}  // namespace

std::optional<AxisScale> find_axis_scale(const Mesh& lumen, const std::vector<Tube>& tubes) {
  const std::vector<Place> places = places_of(tubes);
  if (places.empty()) return {};
  // Squares of what stands out along each axis, and what they were if each cross-section were round.
  Eigen::Array3d is = Eigen::Array3d::Zero(), round = Eigen::Array3d::Zero();
  const std::size_t stride = 1 + lumen.vertices.size() / looked_at;
  for (std::size_t v = 0; v < lumen.vertices.size(); v += stride) {
    const Place& place = nearest(places, lumen.vertices[v]);
    Eigen::Vector3d out = (lumen.vertices[v] - place.p) / place.radius_m;
    const double along = out.dot(place.along);
    out -= along * place.along;
    if (std::fabs(along) > 0.5 || out.norm() > 2.5) continue;  // lids, and walls of vessels that have no tube
    is += out.array().square();
    round += out.squaredNorm() / 2 * (1 - place.along.array().square());
  }
  if (!(round.minCoeff() > 0.05 * round.sum())) return {};  // all run along one axis
  const Eigen::Array3d ratio = is / round;
  AxisScale found;
  for (int k = 0; k < 3; ++k) {
    const double others = (ratio.sum() - ratio[k]) / 2, share = std::sqrt(ratio[k] / others);
    if (std::fabs(std::log(share)) > std::fabs(std::log(found.share))) found = {k, share};
  }
  if (std::fabs(std::log(found.share)) < -std::log(matters)) return {};
  return found;
}

}  // namespace ostium::vascular
