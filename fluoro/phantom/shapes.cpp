#include "fluoro/phantom/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/units.h"
#include "core/math/alignment.h"

namespace ostium::fluoro::phantom {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using units::pi;

namespace {

/// Consecutive rings of `sides` vertices, closed at each end by a pole vertex; the poles come last.
Triangles rings_with_poles(int rings, int sides) {
  Triangles out(3, 2 * sides * rings);
  const int first_pole = rings * sides, last_pole = first_pole + 1;
  Index n = 0;
  for (int j = 0; j < sides; ++j) {
    const int k = (j + 1) % sides, last = (rings - 1) * sides;
    out.col(n++) << first_pole, k, j;
    out.col(n++) << last_pole, last + j, last + k;
    for (int i = 0; i + 1 < rings; ++i) {
      out.col(n++) << i * sides + j, i * sides + k, (i + 1) * sides + k;
      out.col(n++) << i * sides + j, (i + 1) * sides + k, (i + 1) * sides + j;
    }
  }
  return out;
}

Surface surface(Triangles triangles, const Matrix3Xd& p_P) {
  return {std::make_shared<const Triangles>(std::move(triangles)), p_P.cast<float>()};
}

/// Positions of a tube's rings: along the line, and at round ends on a half circle beyond it.
struct Ring {
  Index point;        // index on the line
  double beyond = 0;  // in radii, beyond the end
  double shrunk = 1;
};

std::vector<Ring> rings_of(Index points, bool round_ends) {
  constexpr int cap = 4;
  std::vector<Ring> rings;
  if (round_ends)
    for (int i = 1; i < cap; ++i) rings.push_back({0, -std::cos(i * pi / 2 / cap), std::sin(i * pi / 2 / cap)});
  for (Index i = 0; i < points; ++i) rings.push_back({i});
  if (round_ends)
    for (int i = cap - 1; i > 0; --i)
      rings.push_back({points - 1, std::cos(i * pi / 2 / cap), std::sin(i * pi / 2 / cap)});
  return rings;
}

Vector3d tangent(const Matrix3Xd& line, Index i) {
  const Index last = line.cols() - 1;
  return (line.col(std::min(i + 1, last)) - line.col(std::max<Index>(i - 1, 0))).normalized();
}

}  // namespace

Surface star(const Vector3d& centre, const std::function<double(const Vector3d&)>& radius, int rings,
             const Vector3d& axis) {
  const int sides = 2 * rings;
  const Eigen::Quaterniond turn = core::rotation_between(Vector3d::UnitZ(), axis);
  Matrix3Xd p(3, rings * sides + 2);
  const auto at = [&](const Vector3d& direction) -> Vector3d {
    const Vector3d d = turn * direction;
    return centre + radius(d) * d;
  };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sides; ++j) {
      const double polar = pi * (i + 1) / (rings + 1), azimuth = 2 * pi * j / sides;
      p.col(i * sides + j) =
          at({std::sin(polar) * std::cos(azimuth), -std::sin(polar) * std::sin(azimuth), -std::cos(polar)});
    }
  p.col(rings * sides) = at(-Vector3d::UnitZ());
  p.col(rings * sides + 1) = at(Vector3d::UnitZ());
  Triangles t = rings_with_poles(rings, sides);
  t.row(1).swap(t.row(2));  // the azimuth has the opposite sense here
  return surface(std::move(t), p);
}

Surface ellipsoid(const Vector3d& centre, const Vector3d& semi_axes, int rings, const Eigen::Matrix3d& axes,
                  double exponent) {
  const auto radius = [&](const Vector3d& d) {
    const Vector3d local = (axes.transpose() * d).cwiseAbs().cwiseQuotient(semi_axes);
    return std::pow(local.array().pow(exponent).sum(), -1 / exponent);
  };
  return star(centre, radius, rings, axes.col(1));
}

Surface brick(const Vector3d& least, const Vector3d& most) {
  Matrix3Xd p(3, 8);
  for (int i = 0; i < 8; ++i)
    p.col(i) << (i & 1 ? most : least).x(), (i & 2 ? most : least).y(), (i & 4 ? most : least).z();
  Triangles t(3, 12);
  t << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      2, 3, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7,   //
      3, 1, 7, 6, 5, 4, 7, 3, 6, 2, 7, 5;
  return surface(std::move(t), p);
}

Surface tube(const Matrix3Xd& line, const Eigen::VectorXd& radius_m, int sides, bool round_ends, double flatness,
             const Vector3d& normal) {
  const std::vector<Ring> rings = rings_of(line.cols(), round_ends);
  const auto count = static_cast<Index>(rings.size());
  Matrix3Xd p(3, count * sides + 2);
  Vector3d across = normal;
  if (across.cross(tangent(line, 0)).norm() < 1e-3) across = normal.unitOrthogonal();
  for (Index i = 0; i < count; ++i) {
    const Ring& ring = rings[static_cast<std::size_t>(i)];
    const Vector3d along = tangent(line, ring.point);
    across = (across - across.dot(along) * along).normalized();  // parallel transport: no twist
    const Vector3d beside = along.cross(across);
    const double radius = radius_m[ring.point];
    for (int j = 0; j < sides; ++j) {
      const double angle = 2 * pi * j / sides;
      p.col(i * sides + j) = line.col(ring.point) +
                             radius * (ring.beyond * along +
                                       ring.shrunk * (std::cos(angle) * flatness * across + std::sin(angle) * beside));
    }
  }
  const Index last = line.cols() - 1;
  p.col(count * sides) = line.col(0) - (round_ends ? radius_m[0] : 0) * tangent(line, 0);
  p.col(count * sides + 1) = line.col(last) + (round_ends ? radius_m[last] : 0) * tangent(line, last);
  return surface(rings_with_poles(static_cast<int>(count), sides), p);
}

Eigen::VectorXi tube_points(Index points, int sides, bool round_ends) {
  const std::vector<Ring> rings = rings_of(points, round_ends);
  Eigen::VectorXi out(static_cast<Index>(rings.size()) * sides + 2);
  Index n = 0;
  for (const Ring& ring : rings)
    for (int j = 0; j < sides; ++j) out[n++] = static_cast<int>(ring.point);
  out[n++] = 0;
  out[n] = static_cast<int>(points - 1);
  return out;
}

Eigen::Matrix3Xf tube_centres(const Matrix3Xd& line, int sides, bool round_ends) {
  const Eigen::VectorXi point = tube_points(line.cols(), sides, round_ends);
  Eigen::Matrix3Xf out(3, point.size());
  for (Index i = 0; i < point.size(); ++i) out.col(i) = line.col(point[i]).cast<float>();
  return out;
}

void begin_outside(Surface& tube, int sides, Index longest, const Distance& within) {
  const Index count = (tube.p_P.cols() - 2) / sides, first_pole = count * sides;
  const auto vertex = [&](Index ring, int side) -> Vector3d {
    return tube.p_P.col(ring * sides + side).cast<double>();
  };
  /// Crossing between an inner and an outer point.
  const auto crossing = [&](Vector3d inner, Vector3d outer) {
    for (int i = 0; i < 20; ++i) {
      const Vector3d middle = 0.5 * (inner + outer);
      (within(middle) < 0 ? inner : outer) = middle;
    }
    return Vector3d(0.5 * (inner + outer));
  };
  const Vector3d start = tube.p_P.col(first_pole).cast<double>();
  if (within(start) >= 0) return;
  Vector3d lid = Vector3d::Zero();
  for (int j = 0; j < sides; ++j) {
    Index last = -1;
    while (last + 1 < std::min(longest, count - 1) && within(vertex(last + 1, j)) < 0) ++last;
    const Vector3d p = last < 0 ? vertex(0, j) : crossing(vertex(last, j), vertex(last + 1, j));
    for (Index i = 0; i <= last; ++i) tube.p_P.col(i * sides + j) = p.cast<float>();
    lid += p / sides;
  }
  // The lid follows the curvature of the surface.
  const Vector3d beyond = start + 1.6 * (lid - start);
  if (within(beyond) > 0) lid = crossing(start, beyond);
  tube.p_P.col(first_pole) = lid.cast<float>();
}

double joined(double a, double b, double k) {
  const double h = std::max(k - std::fabs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * h * k / 6;
}

double common(double a, double b, double k) { return -joined(-a, -b, k); }

double from_rod(const Vector3d& p, const Vector3d& a, const Vector3d& b, double radius_a, double radius_b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm() - (radius_a + t * (radius_b - radius_a));
}

Surface net(const Distance& inside, const Vector3d& low, const Vector3d& high, double cell_m) {
  const Eigen::Array3i n = ((high - low) / cell_m).array().ceil().cast<int>() + 1;  // corners
  const int step[3] = {1, n[0], n[0] * n[1]};
  const auto place = [&](int x, int y, int z) { return Vector3d(low + cell_m * Vector3d(x, y, z)); };
  std::vector<double> f(static_cast<std::size_t>(n.prod()));
  for (int z = 0, i = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x) f[static_cast<std::size_t>(i++)] = inside(place(x, y, z));
  const auto at = [&](int i) { return f[static_cast<std::size_t>(i)]; };
  std::vector<int> vertex(f.size(), -1);
  std::vector<Vector3d> sum;
  std::vector<int> crossings;
  std::vector<Eigen::Vector3i> triangles;
  // A cell's vertex starts at the mean of the crossings on its edges; (x, y, z) is the cell's low corner.
  const auto touch = [&](int cell, const Vector3d& p) {
    int& v = vertex[static_cast<std::size_t>(cell)];
    if (v < 0) {
      v = static_cast<int>(sum.size());
      sum.push_back(Vector3d::Zero());
      crossings.push_back(0);
    }
    sum[static_cast<std::size_t>(v)] += p;
    ++crossings[static_cast<std::size_t>(v)];
    return v;
  };
  for (int z = 1; z + 1 < n[2]; ++z)
    for (int y = 1; y + 1 < n[1]; ++y)
      for (int x = 1; x + 1 < n[0]; ++x)
        for (int axis = 0; axis < 3; ++axis) {
          const int i = z * step[2] + y * step[1] + x, u = step[(axis + 1) % 3], v = step[(axis + 2) % 3];
          const double from = at(i), to = at(i + step[axis]);
          if ((from < 0) == (to < 0)) continue;
          const Vector3d p = place(x, y, z) + from / (from - to) * cell_m * Vector3d::Unit(axis);
          std::array<int, 4> q{touch(i - u - v, p), touch(i - v, p), touch(i, p), touch(i - u, p)};
          if (!(from < 0)) std::swap(q[1], q[3]);
          triangles.emplace_back(q[0], q[1], q[2]);
          triangles.emplace_back(q[0], q[2], q[3]);
        }
  Matrix3Xd p(3, static_cast<Index>(sum.size()));
  for (Index i = 0; i < p.cols(); ++i) {
    Vector3d q = sum[static_cast<std::size_t>(i)] / crossings[static_cast<std::size_t>(i)];
    const double h = 0.05 * cell_m;
    for (int pass = 0; pass < 2; ++pass) {
      const double value = inside(q);
      Vector3d slope;
      for (int axis = 0; axis < 3; ++axis) slope[axis] = (inside(q + h * Vector3d::Unit(axis)) - value) / h;
      Vector3d move = -value * slope / std::max(0.1, slope.squaredNorm());
      if (move.norm() > 0.3 * cell_m) move *= 0.3 * cell_m / move.norm();
      q += move;
    }
    p.col(i) = q;
  }
  Triangles t(3, static_cast<Index>(triangles.size()));
  for (Index i = 0; i < t.cols(); ++i) t.col(i) = triangles[static_cast<std::size_t>(i)];
  return surface(std::move(t), p);
}

Matrix3Xd smooth_line(const std::vector<Vector3d>& through, double spacing_m) {
  std::vector<Vector3d> out;
  const auto at = [&](std::size_t i) { return through[std::min(i, through.size() - 1)]; };
  for (std::size_t i = 0; i + 1 < through.size(); ++i) {
    const Vector3d b = at(i), c = at(i + 1), a = i ? at(i - 1) : Vector3d(2 * b - c),
                   d = i + 2 < through.size() ? at(i + 2) : Vector3d(2 * c - b);
    const int steps = std::max(1, static_cast<int>(std::ceil((c - b).norm() / spacing_m)));
    for (int k = 0; k < steps; ++k) {
      const double t = double(k) / steps;
      out.push_back(0.5 *
                    (2 * b + t * (c - a) + t * t * (2 * a - 5 * b + 4 * c - d) + t * t * t * (3 * b - a - 3 * c + d)));
    }
  }
  out.push_back(through.back());
  Matrix3Xd line(3, static_cast<Index>(out.size()));
  for (std::size_t i = 0; i < out.size(); ++i) line.col(static_cast<Index>(i)) = out[i];
  return line;
}

Body body(const std::string& name, const Surface& surface, Tissue inside, Tissue within) {
  return {name, surface.triangles, surface.p_P, inside, within, {}};
}

}  // namespace ostium::fluoro::phantom
