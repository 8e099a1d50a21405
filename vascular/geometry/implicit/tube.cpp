#include "vascular/geometry/implicit/tube.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "vascular/geometry/implicit/spline.h"

namespace ostium::vascular {

namespace {

struct RadiusAt {
  double s_m, radius_m;
};

/// Monotone cubic interpolation (Fritsch and Butland, SIAM J Sci Stat Comput 1984;5:300).
double interpolated_radius(const std::vector<RadiusAt>& table, double s) {
  const std::size_t n = table.size();
  if (s <= table.front().s_m || n == 1) return table.front().radius_m;
  if (s >= table.back().s_m) return table.back().radius_m;
  const auto width = [&](std::size_t i) { return table[i + 1].s_m - table[i].s_m; };
  const auto slope = [&](std::size_t i) { return (table[i + 1].radius_m - table[i].radius_m) / width(i); };
  const auto tangent = [&](std::size_t i) {
    if (i == 0) return slope(0);
    if (i + 1 == n) return slope(n - 2);
    const double a = slope(i - 1), b = slope(i), wa = 2 * width(i) + width(i - 1), wb = width(i) + 2 * width(i - 1);
    return a * b <= 0 ? 0.0 : (wa + wb) / (wa / a + wb / b);
  };
  std::size_t i = 0;
  while (table[i + 1].s_m < s) ++i;
  const double h = width(i), t = (s - table[i].s_m) / h, u = 1 - t;
  return (1 + 2 * t) * u * u * table[i].radius_m + t * u * u * h * tangent(i) +
         t * t * (3 - 2 * t) * table[i + 1].radius_m - t * t * u * h * tangent(i + 1);
}

}  // namespace

TubeNode Tube::at(double s_m) const {
  if (s_m <= 0) return nodes.front();
  if (s_m >= length_m()) return nodes.back();
  const auto above =
      std::upper_bound(nodes.begin(), nodes.end(), s_m, [](double s, const TubeNode& node) { return s < node.s_m; });
  const TubeNode &b = *above, &a = *(above - 1);
  const double t = (s_m - a.s_m) / (b.s_m - a.s_m);
  return {a.p + t * (b.p - a.p), a.radius_m + t * (b.radius_m - a.radius_m), s_m};
}

Eigen::Vector3d Tube::tangent(double s_m) const {
  const double h = std::min(nodes[1].s_m, length_m()) / 2 + 1e-9;
  const double mid = std::clamp(s_m, h, length_m() - h);
  return (at(mid + h).p - at(mid - h).p).normalized();
}

Tube make_tube(const std::string& name, int parent, const std::vector<CoursePoint>& course) {
  assert(course.size() >= 2 && course.front().radius_m > 0 && course.back().radius_m > 0);
  std::vector<Eigen::Vector3d> points;
  for (const CoursePoint& c : course) points.push_back(c.p);
  const CurveSpline curve(points);
  constexpr double fine_m = 0.1e-3;
  std::vector<TubeNode> fine = {{curve.at(0), 0, 0}};
  std::vector<RadiusAt> radii = {{0, course.front().radius_m}};
  for (std::size_t k = 1; k < course.size(); ++k) {
    const double u0 = curve.knots()[k - 1], u1 = curve.knots()[k];
    const int steps = std::max(4, static_cast<int>(std::ceil((u1 - u0) / fine_m)));
    for (int i = 1; i <= steps; ++i) {
      const Eigen::Vector3d p = curve.at(u0 + (u1 - u0) * i / steps);
      fine.push_back({p, 0, fine.back().s_m + (p - fine.back().p).norm()});
    }
    if (course[k].radius_m > 0) radii.push_back({fine.back().s_m, course[k].radius_m});
  }
  Tube tube{.name = name, .parent = parent, .nodes = {}};
  for (TubeNode& node : fine) {
    node.radius_m = interpolated_radius(radii, node.s_m);
    const bool last = &node == &fine.back();
    if (tube.nodes.empty() || last || node.s_m - tube.nodes.back().s_m >= node.radius_m / 4) tube.nodes.push_back(node);
  }
  return tube;
}

double nearest_s(const Tube& tube, const Eigen::Vector3d& p) {
  double best = std::numeric_limits<double>::infinity(), s = 0;
  for (std::size_t i = 0; i + 1 < tube.nodes.size(); ++i) {
    const TubeNode &a = tube.nodes[i], &b = tube.nodes[i + 1];
    const Eigen::Vector3d ab = b.p - a.p;
    const double t = std::clamp((p - a.p).dot(ab) / ab.squaredNorm(), 0.0, 1.0), d = (p - a.p - t * ab).squaredNorm();
    if (d < best) best = d, s = a.s_m + t * (b.s_m - a.s_m);
  }
  return s;
}

TubeUnion::TubeUnion(const std::vector<Tube>& tubes) : tubes_(tubes) {
  for (int t = 0; t < static_cast<int>(tubes.size()); ++t) {
    assert(tubes[t].nodes.size() >= 2 && tubes[t].parent < t);
    for (int n = 0; n + 1 < static_cast<int>(tubes[t].nodes.size()); ++n) {
      const TubeNode &a = tubes[t].nodes[n], &b = tubes[t].nodes[n + 1];
      const Eigen::Vector3d ab = b.p - a.p;
      segments_.push_back({t, n, a.p, ab, ab.squaredNorm(), a.radius_m, b.radius_m - a.radius_m});
      if (tubes[t].parent >= 0)
        largest_blend_m_ = std::max(largest_blend_m_, tubes[t].blend * tubes[t].nodes[n].radius_m);
    }
  }
}

double TubeUnion::distance(int segment, const Eigen::Vector3d& p, double* s_m, double* radius_m) const {
  const Segment& at = segments_[segment];
  const Eigen::Vector3d from_a = p - at.p;
  const double t = std::clamp(from_a.dot(at.along) / at.length2, 0.0, 1.0), radius = at.radius_m + t * at.widening_m;
  if (s_m) {
    const TubeNode &a = tubes_[at.tube].nodes[at.node], &b = tubes_[at.tube].nodes[at.node + 1];
    *s_m = a.s_m + t * (b.s_m - a.s_m);
  }
  if (radius_m) *radius_m = radius;
  return (from_a - t * at.along).norm() - radius;
}

double TubeUnion::value(const Eigen::Vector3d& p, const std::vector<int>& segments, Eigen::Vector3d* gradient,
                        std::vector<TubeShare>* shares) const {
  double f = std::numeric_limits<double>::infinity();
  if (gradient) gradient->setZero();
  if (shares) shares->clear();
  for (std::size_t i = 0; i < segments.size();) {
    const int tube = segments_[segments[i]].tube;
    double d = std::numeric_limits<double>::infinity(), s = 0, radius = 0;
    int nearest = segments[i];
    for (; i < segments.size() && segments_[segments[i]].tube == tube; ++i) {
      double radius_i;
      const double d_i = distance(segments[i], p, nullptr, &radius_i);
      if (d_i < d) d = d_i, nearest = segments[i], radius = radius_i;
    }
    if (gradient || shares) distance(nearest, p, &s);
    // Smooth minimum min(f, d) - k h^3 / 6, h = max(0, 1 - |f - d| / k); weight of the larger one: h^2 / 2.
    const double k = tubes_[tube].blend * radius;
    const double h = std::isinf(f) ? 0 : std::max(0.0, 1 - std::fabs(f - d) / k);
    const double weight_of_d = d < f ? 1 - h * h / 2 : h * h / 2;
    f = std::min(f, d) - k * h * h * h / 6;
    if (gradient && weight_of_d > 0) {
      const Eigen::Vector3d out = p - tubes_[tube].at(s).p;
      *gradient = (1 - weight_of_d) * *gradient + weight_of_d * out.normalized();
    }
    if (shares && weight_of_d > 0) {
      for (TubeShare& share : *shares) share.weight *= 1 - weight_of_d;
      shares->push_back({tube, s, weight_of_d});
    }
  }
  return f;
}

}  // namespace ostium::vascular
