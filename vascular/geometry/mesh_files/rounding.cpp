#include "vascular/geometry/mesh_files/rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostium::vascular {

namespace {

constexpr std::size_t enough = 100;  // corners that are multiples of a power of ten by no chance

template <class Holds>
bool all_numbers(const Mesh& mesh, const Holds& holds) {
  return std::ranges::all_of(mesh.vertices,
                             [&](const Eigen::Vector3d& p) { return std::all_of(p.data(), p.data() + 3, holds); });
}

}  // namespace

double rounding_step(const Mesh& raw) {
  double farthest = 0;
  for (const Eigen::Vector3d& p : raw.vertices) farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
  const bool single = all_numbers(raw, [](double x) { return x == static_cast<double>(static_cast<float>(x)); });
  const float beyond = std::nextafter(static_cast<float>(farthest), std::numeric_limits<float>::infinity());
  const double step =
      (single ? static_cast<double>(beyond) : std::nextafter(farthest, std::numeric_limits<double>::infinity())) -
      farthest;
  if (raw.vertices.size() < enough) return step;
  for (double digit = 1; digit > 2 * step; digit /= 10)
    if (all_numbers(raw, [&](double x) { return std::fabs(x - digit * std::round(x / digit)) <= step; })) return digit;
  return step;
}

}  // namespace ostium::vascular
