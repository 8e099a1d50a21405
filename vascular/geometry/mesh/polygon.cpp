#include "vascular/geometry/mesh/polygon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace ostium::vascular {

namespace {

using Eigen::Vector3d;

/// Twice the area, along it (Newell).
Vector3d normal_of(std::span<const Vector3d> corners) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  return sum;
}

bool inside(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& up) {
  const auto left = [&](const Vector3d& from, const Vector3d& to) { return (to - from).cross(p - from).dot(up) >= 0; };
  return p != a && p != b && p != c && left(a, b) && left(b, c) && left(c, a);
}

}  // namespace

std::vector<std::array<std::size_t, 3>> triangulated(std::span<const Vector3d> corners) {
  constexpr std::size_t many = 1000;
  const Vector3d up = normal_of(corners);
  std::vector<std::array<std::size_t, 3>> out;
  std::vector<std::size_t> left(corners.size());
  std::iota(left.begin(), left.end(), 0);
  const auto is_ear = [&](std::size_t k) {
    const std::size_t a = left[(k + left.size() - 1) % left.size()], b = left[k], c = left[(k + 1) % left.size()];
    if (!((corners[b] - corners[a]).cross(corners[c] - corners[b]).dot(up) > 0)) return false;
    return std::none_of(left.begin(), left.end(),
                        [&](std::size_t i) { return inside(corners[i], corners[a], corners[b], corners[c], up); });
  };
  std::size_t at = 1;  // a convex polygon becomes a fan about its first corner
  while (left.size() > 3 && corners.size() < many) {
    std::size_t tried = 0;
    while (tried < left.size() && !is_ear((at + tried) % left.size())) ++tried;
    if (tried == left.size()) break;
    at = (at + tried) % left.size();
    out.push_back({left[(at + left.size() - 1) % left.size()], left[at], left[(at + 1) % left.size()]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    at %= left.size();
  }
  for (std::size_t k = 2; k < left.size(); ++k) out.push_back({left[0], left[k - 1], left[k]});
  return out;
}

}  // namespace ostium::vascular
