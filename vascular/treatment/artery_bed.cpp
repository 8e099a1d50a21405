#include "vascular/treatment/artery_bed.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/units.h"

namespace ostium::vascular {

using Eigen::Array3d;
using Eigen::Vector3d;

namespace {

/// Three cells in a row: the curvature at the middle one is own z(cell) + middle z(upstream) + second z(second).
struct Joint {
  int cell = 0, upstream = 0, second = 0;
  double own = 0, middle = 0, beyond = 0, width_m = 0;

  Vector3d curvature(const std::vector<Vector3d>& z) const {
    const auto at = [&](int c) -> const Vector3d& { return z[static_cast<std::size_t>(c)]; };
    return own * at(cell) + middle * at(upstream) + beyond * at(second);
  }
};

/// False where there is no such row.
bool joint_at(const ArteryBedModel& m, int cell, Joint& joint) {
  const int up = m.layout.upstream[static_cast<std::size_t>(cell)];
  const int second = up < 0 ? -1 : m.layout.upstream[static_cast<std::size_t>(up)];
  if (second < 0) return false;
  const double a = m.layout.from_m[static_cast<std::size_t>(cell)], b = m.layout.from_m[static_cast<std::size_t>(up)],
               width = (a + b) / 2;
  joint = {cell, up, second, 1 / (a * width), -1 / (a * width) - 1 / (b * width), 1 / (b * width), width};
  return true;
}

/// Adds the energy B / 2 |curvature|^2 over the joint's width.
void add_joint(const Joint& j, double B_N_m2, ArteryBedScratch& x) {
  const double B = B_N_m2 * j.width_m;
  const auto c = static_cast<std::size_t>(j.cell), up = static_cast<std::size_t>(j.upstream),
             second = static_cast<std::size_t>(j.second);
  x.diagonal[c] += B * j.own * j.own;
  x.diagonal[up] += B * j.middle * j.middle;
  x.diagonal[second] += B * j.beyond * j.beyond;
  x.to_upstream[c] += B * j.own * j.middle;
  x.to_second[c] += B * j.own * j.beyond;
  x.to_upstream[up] += B * j.middle * j.beyond;
}

/// The balloon's moment as a spring towards straight, by its secant at the present curvature.
void add_tube(const ArteryBedModel& m, const BedTube& tube, const ArteryBedState& s, ArteryBedScratch& x) {
  Joint j;
  if (!joint_at(m, tube.cell, j)) return;
  const double now = (tube.curvature_P + j.curvature(s.aside_P)).norm(),
               B = now > 1e-3 ? moment_Nm(tube.tube, now) / now : tube.tube.EI_N_m2;
  add_joint(j, B, x);
  const Vector3d pull = -B * j.width_m * tube.curvature_P;
  x.right[static_cast<std::size_t>(j.cell)] += j.own * pull;
  x.right[static_cast<std::size_t>(j.upstream)] += j.middle * pull;
  x.right[static_cast<std::size_t>(j.second)] += j.beyond * pull;
}

/// An origin does not move: its row says so, and nobody else's speaks of it.
void hold_origins(const ArteryBedModel& m, ArteryBedScratch& x) {
  for (std::size_t c = 0; c < m.layout.upstream.size(); ++c) {
    const int up = m.layout.upstream[c];
    if (up < 0) {
      x.diagonal[c] = 1, x.right[c].setZero();
      continue;
    }
    if (const int second = m.layout.upstream[static_cast<std::size_t>(up)]; second < 0)
      x.to_upstream[c] = 0;
    else if (m.layout.upstream[static_cast<std::size_t>(second)] < 0)
      x.to_second[c] = 0;
  }
}

/// From the ends to the origins and back. A cell meets only the two upstream of it, which are neighbours themselves:
/// eliminating it adds no other entry.
void solve(const ArteryBedModel& m, ArteryBedScratch& x, std::vector<Vector3d>& z) {
  const auto upstream = [&](std::size_t c) { return static_cast<std::size_t>(m.layout.upstream[c]); };
  for (std::size_t c = m.layout.upstream.size(); c-- > 0;) {
    if (m.layout.upstream[c] < 0) continue;
    const std::size_t up = upstream(c);
    const double a = x.to_upstream[c] / x.diagonal[c];
    x.diagonal[up] -= a * x.to_upstream[c], x.right[up] -= a * x.right[c];
    if (m.layout.upstream[up] < 0) continue;
    const std::size_t second = upstream(up);
    const double b = x.to_second[c] / x.diagonal[c];
    x.to_upstream[up] -= a * x.to_second[c];
    x.diagonal[second] -= b * x.to_second[c], x.right[second] -= b * x.right[c];
  }
  for (std::size_t c = 0; c < m.layout.upstream.size(); ++c) {
    Vector3d sum = x.right[c];
    if (m.layout.upstream[c] >= 0) {
      sum -= x.to_upstream[c] * z[upstream(c)];
      if (m.layout.upstream[upstream(c)] >= 0) sum -= x.to_second[c] * z[upstream(upstream(c))];
    }
    z[c] = sum / x.diagonal[c];
  }
}

bool is_too_steep(const ArteryBedModel& m, const std::vector<Vector3d>& z) {
  return std::any_of(m.layout.ties.begin(), m.layout.ties.end(), [&](const ArteryTie& tie) {
    const Array3d apart = z[static_cast<std::size_t>(tie.a)] - z[static_cast<std::size_t>(tie.b)];
    return (apart.abs() > m.law.steepest * tie.room_m).any();
  });
}

/// Makes z no steeper than it may be: half-way between the largest function that is not and lies below it, and the
/// smallest above (McShane 1934). Where z is not too steep, all three are the same.
void flatten(const ArteryBedModel& m, ArteryBedScratch& x, std::vector<Vector3d>& z) {
  x.lower.assign(z.begin(), z.end()), x.upper = x.lower;
  bool changes = true;
  const auto relax = [&](const ArteryTie& tie) {
    const auto a = static_cast<std::size_t>(tie.a), b = static_cast<std::size_t>(tie.b);
    const double may_m = m.law.steepest * tie.room_m;
    const auto lower = [&](Array3d& to, const Array3d& from) {
      if (!(to > from + may_m).any()) return;
      to = to.min(from + may_m), changes = true;
    };
    const auto raise = [&](Array3d& to, const Array3d& from) {
      if (!(to < from - may_m).any()) return;
      to = to.max(from - may_m), changes = true;
    };
    lower(x.lower[a], x.lower[b]), lower(x.lower[b], x.lower[a]);
    raise(x.upper[a], x.upper[b]), raise(x.upper[b], x.upper[a]);
  };
  while (changes) {
    changes = false;
    std::for_each(m.layout.ties.begin(), m.layout.ties.end(), relax);    // to the ends
    std::for_each(m.layout.ties.rbegin(), m.layout.ties.rend(), relax);  // and back
  }
  for (std::size_t c = 0; c < z.size(); ++c) z[c] = (x.lower[c] + x.upper[c]) / 2;
}

void limit(const ArteryBedModel& m, ArteryBedScratch& x, std::vector<Vector3d>& z) {
  for (std::size_t c = 0; c < z.size(); ++c) {
    if (const double far_m = z[c].norm(); far_m > m.law.most_aside_m) z[c] *= m.law.most_aside_m / far_m;
    const double anchored_m = m.law.steepest * m.layout.anchored_m[c];
    z[c] = z[c].array().min(anchored_m).max(-anchored_m);
  }
  if (is_too_steep(m, z)) flatten(m, x, z);
}

}  // namespace

ArteryBedModel make_artery_bed(const FlowTree& tree, ArteryLayout layout, const ArteryBedLaw& law) {
  ArteryBedModel m{.law = law, .layout = std::move(layout), .length_m = {}, .EI_N_m2 = {}};
  for (const FlowCell& cell : tree.cells) {
    const double r = cell.healthy_m;
    m.length_m.push_back(cell.length_m);
    m.EI_N_m2.push_back(units::pi * r * r * r * law.wall_m * law.wall_Pa);
  }
  return m;
}

void step(const ArteryBedModel& m, const ArteryBedInputs& in, double dt, ArteryBedState& s, ArteryBedScratch& x) {
  const std::size_t n = m.layout.upstream.size();
  const double lags = m.law.bed_N_m2 * m.law.yields_s / dt, holds = m.law.bed_N_m2 + lags;
  x.diagonal.resize(n), x.right.resize(n);
  x.to_upstream.assign(n, 0), x.to_second.assign(n, 0);
  for (std::size_t c = 0; c < n; ++c)
    x.diagonal[c] = m.length_m[c] * holds, x.right[c] = in.load_P_N[c] + m.length_m[c] * lags * s.aside_P[c];
  Joint joint;
  for (std::size_t c = 0; c < n; ++c)
    if (joint_at(m, static_cast<int>(c), joint))
      add_joint(joint, m.EI_N_m2[static_cast<std::size_t>(joint.upstream)], x);
  for (const BedTube& tube : in.tubes) add_tube(m, tube, s, x);
  hold_origins(m, x);
  solve(m, x, s.aside_P);
  limit(m, x, s.aside_P);
}

Vector3d curvature_of(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double before_m = (b - a).norm(), after_m = (c - b).norm();
  if (!(before_m > 0) || !(after_m > 0)) return Vector3d::Zero();
  return 2 / (before_m + after_m) * ((c - b) / after_m - (b - a) / before_m);
}

}  // namespace ostium::vascular
