#include "fluoro/phantom/heart.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/units.h"
#include "fluoro/phantom/coronaries.h"

namespace ostium::fluoro::phantom {

using Eigen::Vector3d;
using units::pi;

namespace {

constexpr int rows = 90, columns = 180;  // of the table: polar angle about y, azimuth

/// Around every point: the hull of spheres that have the middle and the point as poles.
double hull(const std::vector<Vector3d>& points, const Vector3d& direction) {
  double sum = 0;
  for (const Vector3d& p : points) sum += std::exp(500 * std::max(0.0, (p - heart_middle()).dot(direction)));
  return std::log(sum / 2.0) / 500 + 0.002;
}

Vector3d direction_at(double row, double column) {
  const double polar = pi * row / rows, azimuth = 2 * pi * column / columns;
  return {std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth)};
}

/// The hull averaged over about ten degrees around each direction.
Eigen::ArrayXXd table() {
  std::vector<Vector3d> points = epicardial_points();
  points.emplace_back(-0.052, -0.015, 0.02);  // right atrium
  points.emplace_back(-0.05, -0.035, 0.018);
  points.emplace_back(-0.02, 0.05, 0.03);  // outflow tract
  constexpr int samples = 1500;
  std::vector<Vector3d> towards;
  std::vector<double> far;
  for (int i = 0; i < samples; ++i) {  // uniform on the sphere: Fibonacci spiral
    const double y = 1 - (2 * i + 1.0) / samples, turn = pi * (1 + std::sqrt(5.0)) * i, flat = std::sqrt(1 - y * y);
    towards.emplace_back(flat * std::cos(turn), y, flat * std::sin(turn));
    far.push_back(hull(points, towards.back()));
  }
  Eigen::ArrayXXd out(rows + 1, columns);
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j < columns; ++j) {
      double sum = 0, weights = 0;
      for (int k = 0; k < samples; ++k) {
        const double close = towards[static_cast<std::size_t>(k)].dot(direction_at(i, j));
        if (close < 0.8) continue;
        const double weight = std::exp(45 * (close - 1));
        sum += weight * far[static_cast<std::size_t>(k)];
        weights += weight;
      }
      out(i, j) = sum / weights;
    }
  return out;
}

}  // namespace

Vector3d heart_middle() { return {0.004, -0.004, 0.004}; }

double heart_radius(const Vector3d& direction) {
  static const Eigen::ArrayXXd radius = table();
  const double row = std::acos(std::clamp(direction.y(), -1.0, 1.0)) / pi * rows;
  double column = std::atan2(direction.z(), direction.x()) / (2 * pi) * columns;
  if (column < 0) column += columns;
  const int i = std::min(static_cast<int>(row), rows - 1), j = static_cast<int>(column) % columns,
            k = (j + 1) % columns;
  const double u = row - i, v = column - std::floor(column);
  return (1 - u) * ((1 - v) * radius(i, j) + v * radius(i, k)) +
         u * ((1 - v) * radius(i + 1, j) + v * radius(i + 1, k));
}

}  // namespace ostium::fluoro::phantom
