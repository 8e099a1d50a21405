/// Linking number of a closed rod, Lk = Tw + Wr (Calugareanu 1959, White 1969), while a ring twisted beyond its
/// stability writhes out of its plane: it stays constant as long as the rod does not cross itself.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "app/gates/gate.h"
#include "core/base/units.h"
#include "core/math/alignment.h"
#include "core/samples/steel_wire.h"

namespace ostium::app::gates {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using units::pi;

/// Writhe of a closed polygon, exact: the sum over pairs of edges of the solid angle under which they cross (Klenin and
/// Langowski 2000, Biopolymers 54:307, method 1a; after Banchoff 1976).
double writhe(const std::vector<Vector3d>& p) {
  const int n = static_cast<int>(p.size());
  const auto safe_asin = [](double x) { return std::asin(std::clamp(x, -1.0, 1.0)); };
  double sum = 0;
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < i; ++j) {
      const Vector3d &r1 = p[i], &r2 = p[(i + 1) % n], &r3 = p[j], &r4 = p[(j + 1) % n];
      const Vector3d r13 = r3 - r1, r14 = r4 - r1, r23 = r3 - r2, r24 = r4 - r2, r34 = r4 - r3, r12 = r2 - r1;
      const double side = r34.cross(r12).dot(r13);
      if (side == 0 || j == i - 1 || (i == n - 1 && j == 0)) continue;
      const Vector3d n1 = r13.cross(r14).normalized(), n2 = r14.cross(r24).normalized(),
                     n3 = r24.cross(r23).normalized(), n4 = r23.cross(r13).normalized();
      const double area = safe_asin(n1.dot(n2)) + safe_asin(n2.dot(n3)) + safe_asin(n3.dot(n4)) + safe_asin(n4.dot(n1));
      sum += std::copysign(area, side);
    }
  return sum / (2 * pi);
}

/// Smallest distance between nodes at least a tenth of the ring apart along it.
double closest_approach(const core::RodState& rod) {
  const int N = rod.orientation.size(), apart = N / 10;
  double least = 1e9;
  for (int i = 0; i < N; ++i)
    for (int j = i + apart; j < N && j <= i + N - apart; ++j)
      least = std::min(least, (rod.position[i] - rod.position[j]).norm());
  return least;
}

/// Angle between director d1 of `a`, parallel transported along the shortest rotation of its tangent, and d1 of `b`.
double twist_between(const Quaterniond& a, const Quaterniond& b) {
  const Vector3d ta = a * Vector3d::UnitZ(), tb = b * Vector3d::UnitZ();
  const Vector3d carried = core::rotation_between(ta, tb) * (a * Vector3d::UnitX()), d1 = b * Vector3d::UnitX();
  return std::atan2(carried.cross(d1).dot(tb), carried.dot(d1));
}

/// Tw + Wr in turns, except for whole turns of the closing joint's twist, which the caller counts.
double link(const core::RodState& rod, double closing_twist_rad) {
  const int N = rod.orientation.size();
  const auto frame = [&](int j) {
    const Eigen::Vector4d q = rod.orientation[j];
    return Quaterniond(q[0], q[1], q[2], q[3]);
  };
  double twist = closing_twist_rad;
  std::vector<Vector3d> nodes;
  for (int j = 0; j < N; ++j) {
    nodes.push_back(rod.position[j]);
    if (j > 0) twist += twist_between(frame(j - 1), frame(j));
  }
  return twist / (2 * pi) + writhe(nodes);
}

}  // namespace

std::vector<data::GateResult> rod_link(bool quick) {
  const int elements = quick ? 100 : 160;
  core::Bench bench = core::steel_bench({.elements = elements, .gravity = false});
  const core::Rod& rod = bench.model.rods[0];
  const Vector3d stiffness = stiffness_at_rest(rod, 1);
  const double twist_rad = 1.3 * 2 * pi * std::sqrt(3.0) * stiffness[0] / stiffness[2];
  lay_out_ring(rod, twist_rad, bench.rod());
  bench.inputs.rods[0].tip.hold = core::Hold::clamped;
  bench.inputs.rods[0].base.hold = core::Hold::clamped;
  // Breaks the symmetry.
  for (int i = elements / 4; i < elements / 2; ++i) bench.rod().velocity.set(i, Vector3d(0, 0.01, 0));

  // The closing section joins the last element to the first; its twist is tracked so that whole turns count.
  const auto closing = [&] {
    const Eigen::Vector4d a = bench.rod().orientation[elements - 1], b = bench.rod().orientation[0];
    // The far frame is the near one turned by `twist_rad` about the tangent.
    const Quaterniond last(a[0], a[1], a[2], a[3]), first(b[0], b[1], b[2], b[3]);
    return twist_between(last, first);
  };
  double closing_before = closing(), closing_sum = closing_before;
  const double before = link(bench.rod(), closing_sum);
  // Until the rod is about to cross itself, which nothing prevents here.
  double worst = 0, writhe_turns = 0;
  for (int ms = 1; ms <= 2000 && closest_approach(bench.rod()) > 0.02; ++ms) {
    bench.step();
    const double now = closing();
    closing_sum += std::remainder(now - closing_before, 2 * pi);
    closing_before = now;
    worst = std::max(worst, std::fabs(link(bench.rod(), closing_sum) - before));
    std::vector<Vector3d> nodes;
    for (int i = 0; i < elements; ++i) nodes.push_back(bench.rod().position[i]);
    writhe_turns = std::max(writhe_turns, std::fabs(writhe(nodes)));
  }
  return {{"rod-link-constant", worst, 0, 1e-6, "turns"},
          // A ring that stays planar has no writhe and would pass the first check; a figure of eight has about one
          // turn.
          {"rod-link-writhe-reached", writhe_turns, 1, 0.4, "turns"}};
}

}  // namespace ostium::app::gates
