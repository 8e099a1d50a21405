#pragma once
/// Nearest point of a triangle, and crossing by a path.
#include "core/math/lanes.h"

namespace ostium::core {

/// A point of a triangle abc: a + u (b - a) + v (c - a).
struct TrianglePoint {
  double u = 0, v = 0;
};

inline V3<double> at(const TrianglePoint& p, const V3<double>& a, const V3<double>& b, const V3<double>& c) {
  return madd(p.v, c - a, madd(p.u, b - a, a));
}

/// Nearest point of the triangle to x (after Ericson, Real-Time Collision Detection, 2005, 5.1.5).
inline TrianglePoint nearest(const V3<double>& x, const V3<double>& a, const V3<double>& b, const V3<double>& c) {
  const V3<double> ab = b - a, ac = c - a, ax = x - a;
  const double d1 = dot(ab, ax), d2 = dot(ac, ax);
  if (d1 <= 0 && d2 <= 0) return {0, 0};
  const V3<double> bx = x - b;
  const double d3 = dot(ab, bx), d4 = dot(ac, bx);
  if (d3 >= 0 && d4 <= d3) return {1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {d1 / (d1 - d3), 0};
  const V3<double> cx = x - c;
  const double d5 = dot(ab, cx), d6 = dot(ac, cx);
  if (d6 >= 0 && d5 <= d6) return {0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {1 - w, w};
  }
  const double scale = 1 / (va + vb + vc);
  return {scale * vb, scale * vc};
}

/// Whether the path from x to y leaves through the triangle, against its inward normal; `part` is the share of the path
/// at the crossing.
inline bool leaves_through(const V3<double>& x, const V3<double>& y, const V3<double>& a, const V3<double>& b,
                           const V3<double>& c, double& part) {
  const V3<double> ab = b - a, ac = c - a, d = y - x, h = cross(d, ac);
  const double det = dot(ab, h);  // -d . (ab x ac): negative if d points along the outward normal
  if (!(det < 0)) return false;
  const V3<double> ax = x - a, q = cross(ax, ab);
  const double u = dot(ax, h) / det, v = dot(d, q) / det;
  part = dot(ac, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && part >= 0 && part <= 1;
}

}  // namespace ostium::core
