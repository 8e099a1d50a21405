#include "vascular/thorax/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace ostium::vascular {

namespace {

using units::pi;

/// Rings of `columns` vertices, closed by a pole at either end; faces outwards if the rings run counter-clockwise about
/// the direction from last to first ring.
Mesh from_rings(const std::vector<std::vector<Eigen::Vector3d>>& rings, const Eigen::Vector3d& first,
                const Eigen::Vector3d& last) {
  Mesh mesh;
  const int columns = static_cast<int>(rings.front().size()), n = static_cast<int>(rings.size());
  mesh.vertices.push_back(first);
  for (const auto& ring : rings) mesh.vertices.insert(mesh.vertices.end(), ring.begin(), ring.end());
  mesh.vertices.push_back(last);
  const int end = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [&](int i, int j) { return 1 + i * columns + j % columns; };
  for (int j = 0; j < columns; ++j) {
    mesh.triangles.push_back({0, at(0, j), at(0, j + 1)});
    for (int i = 0; i + 1 < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.triangles.push_back({end, at(n - 1, j + 1), at(n - 1, j)});
  }
  return mesh;
}

/// Bit k of a case: corner k (bits x, y, z) is inside. Whether inside and outside are each connected along the edges.
bool simple(int corners) {
  for (int side : {corners, ~corners & 255}) {
    if (!side) continue;
    int reached = side & -side;
    for (int pass = 0; pass < 8; ++pass)
      for (int k = 0; k < 8; ++k)
        if (reached >> k & 1)
          for (int axis = 0; axis < 3; ++axis) reached |= side & 1 << (k ^ 1 << axis);
    if (reached != side) return false;
  }
  return true;
}

}  // namespace

double signed_power(double x, double e) { return std::copysign(std::pow(std::fabs(x), e), x); }

Mesh superellipsoid(const Eigen::Vector3d& middle, const Eigen::Vector3d& half_axes, double exponent,
                    const Eigen::Matrix3d& axes, int rows) {
  const double e = 2 / exponent;
  std::vector<std::vector<Eigen::Vector3d>> rings;
  const auto place = [&](double theta, double phi) {
    const Eigen::Vector3d p(signed_power(std::sin(theta), e) * signed_power(std::cos(phi), e),
                            signed_power(std::sin(theta), e) * signed_power(std::sin(phi), e),
                            signed_power(std::cos(theta), e));
    return Eigen::Vector3d(middle + axes * p.cwiseProduct(half_axes));
  };
  for (int i = 1; i < rows; ++i) {
    rings.emplace_back();
    for (int j = 0; j < 2 * rows; ++j) rings.back().push_back(place(pi * i / rows, pi * (j + 0.5) / rows));
  }
  return from_rings(rings, place(0, 0), place(pi, 0));
}

Mesh swept_ellipse(const std::vector<Eigen::Vector3d>& line, double tall, double thick, const Eigen::Vector3d& up) {
  return swept_ellipse(line, std::vector<Eigen::Vector2d>(line.size(), {tall, thick}), up);
}

Mesh swept_ellipse(const std::vector<Eigen::Vector3d>& line, const std::vector<Eigen::Vector2d>& tall_thick,
                   const Eigen::Vector3d& up) {
  constexpr int columns = 16, cap = 3;
  std::vector<std::vector<Eigen::Vector3d>> rings;
  const auto ring = [&](const Eigen::Vector3d& middle, const Eigen::Vector3d& along, const Eigen::Vector2d& half) {
    const Eigen::Vector3d high = (up - up.dot(along) * along).normalized(), wide = along.cross(high);
    rings.emplace_back();
    for (int j = 0; j < columns; ++j) {
      const double a = 2 * pi * j / columns;
      rings.back().push_back(middle + half[0] * std::sin(a) * high + half[1] * std::cos(a) * wide);
    }
  };
  const std::size_t n = line.size();
  const Eigen::Vector3d start = (line[1] - line[0]).normalized(), stop = (line[n - 1] - line[n - 2]).normalized();
  const double first = tall_thick.front().minCoeff(), last = tall_thick.back().minCoeff();
  for (int i = 1; i <= cap; ++i) {
    const double a = pi / 2 * i / (cap + 1);
    ring(line[0] - first * std::cos(a) * start, start, std::sin(a) * tall_thick.front());
  }
  for (std::size_t i = 0; i < n; ++i)
    ring(line[i], (line[std::min(i + 1, n - 1)] - line[i ? i - 1 : 0]).normalized(), tall_thick[i]);
  for (int i = cap; i >= 1; --i) {
    const double a = pi / 2 * i / (cap + 1);
    ring(line[n - 1] + last * std::cos(a) * stop, stop, std::sin(a) * tall_thick.back());
  }
  return from_rings(rings, line[0] - first * start, line[n - 1] + last * stop);
}

Mesh rod(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius_a, double radius_b, int sides) {
  return rod({a, b}, {radius_a, radius_b}, sides);
}

Mesh rod(const std::vector<Eigen::Vector3d>& line, const std::vector<double>& radius, int sides) {
  // The polygon's area is that of the circle.
  const double wider = std::sqrt(2 * pi / (sides * std::sin(2 * pi / sides)));
  const std::size_t n = line.size();
  std::vector<std::vector<Eigen::Vector3d>> rings;
  Eigen::Vector3d u = (line[1] - line[0]).unitOrthogonal();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d along = (line[std::min(i + 1, n - 1)] - line[i ? i - 1 : 0]).normalized();
    u = (u - u.dot(along) * along).normalized();  // turned with the line, not about it
    const Eigen::Vector3d v = along.cross(u);
    rings.emplace_back();
    for (int j = 0; j < sides; ++j) {
      const double a = 2 * pi * j / sides;
      rings.back().push_back(line[i] + wider * radius[i] * (std::sin(a) * u + std::cos(a) * v));
    }
  }
  return from_rings(rings, line.front() - radius.front() * (line[1] - line[0]).normalized(),
                    line.back() + radius.back() * (line[n - 1] - line[n - 2]).normalized());
}

double joined(double a, double b, double k) {
  const double h = std::max(k - std::fabs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * h * k / 6;
}

double from_rod(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius_a,
                double radius_b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm() - (radius_a + t * (radius_b - radius_a));
}

Mesh surface_net(const std::function<double(const Eigen::Vector3d&)>& inside, const Eigen::Vector3d& low,
                 const Eigen::Vector3d& high, double cell_m) {
  const Eigen::Array3i n = ((high - low) / cell_m).array().ceil().cast<int>() + 1;  // corners
  const auto index = [&](int x, int y, int z) { return (z * n[1] + y) * n[0] + x; };
  const auto place = [&](int x, int y, int z) { return Eigen::Vector3d(low + cell_m * Eigen::Vector3d(x, y, z)); };
  std::vector<double> f(static_cast<std::size_t>(n.prod()));
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x) f[index(x, y, z)] = inside(place(x, y, z));
  // Where two sheets pass through one cell, its inner corner nearest to the surface goes outside: the thinnest is cut.
  // No corner ever comes back, so this ends.
  std::array<bool, 256> is_simple;
  for (int c = 0; c < 256; ++c) is_simple[static_cast<std::size_t>(c)] = simple(c);
  for (bool changed = true; changed;) {
    changed = false;
    for (int z = 0; z + 1 < n[2]; ++z)
      for (int y = 0; y + 1 < n[1]; ++y)
        for (int x = 0; x + 1 < n[0]; ++x) {
          int corners = 0, nearest = -1;
          for (int k = 0; k < 8; ++k) {
            const int i = index(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2));
            if (!(f[i] < 0)) continue;
            corners |= 1 << k;
            if (nearest < 0 || f[i] > f[nearest]) nearest = i;
          }
          if (is_simple[static_cast<std::size_t>(corners)]) continue;
          f[nearest] = 0.1 * cell_m - 0.5 * f[nearest];
          changed = true;
        }
  }
  Mesh mesh;
  std::vector<int> vertex(f.size(), -1), crossings(f.size(), 0);
  // A cell's vertex is the mean of the crossings on its edges; cell (x, y, z) has its low corner there.
  const int step[3] = {1, n[0], n[0] * n[1]};
  const auto touch = [&](int cell, const Eigen::Vector3d& p) {
    if (vertex[cell] < 0) {
      vertex[cell] = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(Eigen::Vector3d::Zero());
    }
    mesh.vertices[vertex[cell]] += p;
    ++crossings[vertex[cell]];
  };
  for (int z = 1; z + 1 < n[2]; ++z)
    for (int y = 1; y + 1 < n[1]; ++y)
      for (int x = 1; x + 1 < n[0]; ++x)
        for (int axis = 0; axis < 3; ++axis) {
          const int i = index(x, y, z), j = i + step[axis], u = step[(axis + 1) % 3], v = step[(axis + 2) % 3];
          if ((f[i] < 0) == (f[j] < 0)) continue;
          const Eigen::Vector3d p = place(x, y, z) + f[i] / (f[i] - f[j]) * cell_m * Eigen::Vector3d::Unit(axis);
          for (int cell : {i, i - u, i - v, i - u - v}) touch(cell, p);
          std::array<int, 4> q = {vertex[i - u - v], vertex[i - v], vertex[i], vertex[i - u]};
          if (!(f[i] < 0)) std::swap(q[1], q[3]);
          mesh.triangles.push_back({q[0], q[1], q[2]});
          mesh.triangles.push_back({q[0], q[2], q[3]});
        }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) mesh.vertices[i] /= crossings[i];
  return mesh;
}

}  // namespace ostium::vascular
