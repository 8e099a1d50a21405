#include "vascular/treatment/artery_bed.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace ostium::vascular {

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
  const int up = m.upstream[static_cast<std::size_t>(cell)];
  const int second = up < 0 ? -1 : m.upstream[static_cast<std::size_t>(up)];
  if (second < 0) return false;
  const double a = m.from_m[static_cast<std::size_t>(cell)], b = m.from_m[static_cast<std::size_t>(up)],
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
  for (std::size_t c = 0; c < m.upstream.size(); ++c) {
    const int up = m.upstream[c];
    if (up < 0) {
      x.diagonal[c] = 1, x.right[c].setZero();
      continue;
    }
    if (const int second = m.upstream[static_cast<std::size_t>(up)]; second < 0)
      x.to_upstream[c] = 0;
    else if (m.upstream[static_cast<std::size_t>(second)] < 0)
      x.to_second[c] = 0;
  }
}

/// From the ends to the origins and back. A cell meets only the two upstream of it, which are neighbours themselves:
/// eliminating it adds no other entry.
void solve(const ArteryBedModel& m, ArteryBedScratch& x, std::vector<Vector3d>& z) {
  const auto upstream = [&](std::size_t c) { return static_cast<std::size_t>(m.upstream[c]); };
  for (std::size_t c = m.upstream.size(); c-- > 0;) {
    if (m.upstream[c] < 0) continue;
    const std::size_t up = upstream(c);
    const double a = x.to_upstream[c] / x.diagonal[c];
    x.diagonal[up] -= a * x.to_upstream[c], x.right[up] -= a * x.right[c];
    if (m.upstream[up] < 0) continue;
    const std::size_t second = upstream(up);
    const double b = x.to_second[c] / x.diagonal[c];
    x.to_upstream[up] -= a * x.to_second[c];
    x.diagonal[second] -= b * x.to_second[c], x.right[second] -= b * x.right[c];
  }
  for (std::size_t c = 0; c < m.upstream.size(); ++c) {
    Vector3d sum = x.right[c];
    if (m.upstream[c] >= 0) {
      sum -= x.to_upstream[c] * z[upstream(c)];
      if (m.upstream[upstream(c)] >= 0) sum -= x.to_second[c] * z[upstream(upstream(c))];
    }
    z[c] = sum / x.diagonal[c];
  }
}

/// v, or what of it is no longer than `most`.
Vector3d at_most(const Vector3d& v, double most) {
  const double length = v.norm();
  return length > most ? Vector3d(most / length * v) : v;
}

/// From the origins to the ends; a cell comes after the one upstream of it.
void limit(const ArteryBedModel& m, std::vector<Vector3d>& z) {
  for (std::size_t c = 0; c < z.size(); ++c) {
    z[c] = at_most(z[c], m.law.most_aside_m);
    if (m.upstream[c] < 0) continue;
    const Vector3d& up = z[static_cast<std::size_t>(m.upstream[c])];
    z[c] = up + at_most(z[c] - up, m.law.steepest * m.from_m[c]);
  }
}

}  // namespace

ArteryBedModel make_artery_bed(const FlowTree& tree, const ArteryBedLaw& law) {
  ArteryBedModel m{.law = law, .upstream = {}, .length_m = {}, .from_m = {}, .EI_N_m2 = {}};
  for (const FlowCell& cell : tree.cells) {
    const double r = cell.healthy_m;
    m.upstream.push_back(cell.upstream);
    m.length_m.push_back(cell.length_m);
    m.from_m.push_back(
        cell.upstream < 0 ? 0 : (cell.length_m + tree.cells[static_cast<std::size_t>(cell.upstream)].length_m) / 2);
    m.EI_N_m2.push_back(units::pi * r * r * r * law.wall_m * law.wall_Pa);
  }
  return m;
}

void step(const ArteryBedModel& m, const ArteryBedInputs& in, double dt, ArteryBedState& s, ArteryBedScratch& x) {
  const std::size_t n = m.upstream.size();
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
  limit(m, s.aside_P);
}

Vector3d curvature_of(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double before_m = (b - a).norm(), after_m = (c - b).norm();
  if (!(before_m > 0) || !(after_m > 0)) return Vector3d::Zero();
  return 2 / (before_m + after_m) * ((c - b) / after_m - (b - a) / before_m);
}

}  // namespace ostium::vascular
