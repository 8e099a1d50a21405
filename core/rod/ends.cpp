#include "core/rod/ends.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/tolerances.h"
#include "core/math/rotation.h"
#include "core/model/report.h"
#include "core/rod/inertia.h"

namespace ostium::core {

namespace {

using Eigen::Vector3d;

Vector3d within(const Vector3d& asked, double limit, std::uint32_t limit_flag, std::uint32_t& trouble) {
  if (!asked.allFinite()) {
    trouble |= drive_not_finite;
    return Vector3d::Zero();
  }
  // Scale first: the norm of 1e300 m/s overflows.
  const double largest = asked.cwiseAbs().maxCoeff();
  if (largest <= limit && asked.norm() <= limit) return asked;
  trouble |= limit_flag;
  return limit * (asked / largest).normalized();
}

bool is_finite(const Tether& a) {
  return std::isfinite(a.from_tip_m) && a.point_W.allFinite() && a.along_W.allFinite() && std::isfinite(a.along_N_m) &&
         std::isfinite(a.across_N_m);
}

bool joined(Hold hold) { return hold == Hold::clamped || hold == Hold::guided; }

void drive(const EndDrive& drive, double step_s, EndState& end) {
  if (drive.hold == Hold::free) return;
  end.p_W += step_s * drive.velocity_W_m_s;
  const Vector3d turn = step_s * drive.turn_rate_W_rad_s;
  const double angle = turn.norm();
  if (angle == 0) return;
  const Eigen::Quaterniond rotated = Eigen::AngleAxisd(angle, turn / angle) * to_eigen(end.frame());
  end.q_W = Eigen::Vector4d(rotated.w(), rotated.x(), rotated.y(), rotated.z()).normalized();
}

void hold(Hold hold, const EndState& end, int node, RodScratch& scratch) {
  if (hold == Hold::free) return;
  Vector3d target = end.p_W;
  // When retried from rest, an end that was pulled off its hold returns no faster than a hand would move it.
  if (scratch.scheme == TimeScheme::from_rest) {
    const Vector3d away = end.p_W - scratch.target[node];
    if (away.norm() > tolerances::longest_return_m)
      target = scratch.target[node] + tolerances::longest_return_m * away.normalized();
  }
  S3<double> P{};
  if (hold == Hold::guided) {
    const Vector3d a = to_eigen(director3(end.frame()));
    target += a * a.dot(scratch.target[node] - end.p_W);
    const double p = a.dot(to_eigen(load6<double>(scratch.chain.compliance, node) * from_eigen(a)));
    P = {p * a.x() * a.x(), p * a.x() * a.y(), p * a.x() * a.z(),
         p * a.y() * a.y(), p * a.y() * a.z(), p * a.z() * a.z()};
  }
  store6(scratch.chain.compliance, node, P);
  scratch.target.set(node, target);
}

}  // namespace

RodInputs limited(const RodInputs& asked, std::uint32_t& trouble) {
  RodInputs out = asked;
  for (EndDrive* d : {&out.base, &out.tip}) {
    d->velocity_W_m_s = within(d->velocity_W_m_s, tolerances::max_drive_speed_m_s, drive_limited, trouble);
    d->turn_rate_W_rad_s = within(d->turn_rate_W_rad_s, tolerances::max_drive_turn_rad_s, drive_limited, trouble);
  }
  out.feed_m_s = within(Vector3d(asked.feed_m_s, 0, 0), tolerances::max_drive_speed_m_s, drive_limited, trouble).x();
  out.tip_force_W_N = within(out.tip_force_W_N, tolerances::max_load_N, load_limited, trouble);
  out.load.force_W_N = within(out.load.force_W_N, tolerances::max_load_N, load_limited, trouble);
  for (Tether& tether : out.tethers)
    if (!is_finite(tether)) tether = {}, trouble |= drive_not_finite;
  return out;
}

EndJoints joints_of(const RodInputs& inputs) { return {joined(inputs.base.hold), joined(inputs.tip.hold)}; }

bool take_hold(const RodInputs& inputs, RodState& state) {
  const bool changed = inputs.base.hold != state.base.hold || inputs.tip.hold != state.tip.hold;
  state.base.hold = inputs.base.hold, state.tip.hold = inputs.tip.hold;
  return changed;
}

void drive_ends(const RodInputs& inputs, double step_s, RodState& state) {
  drive(inputs.base, step_s, state.base);
  drive(inputs.tip, step_s, state.tip);
}

void hold_ends(const Rod& rod, const RodInputs& inputs, const RodState& state, RodScratch& scratch) {
  hold(inputs.base.hold, state.base, rod.first, scratch);
  hold(inputs.tip.hold, state.tip, rod.elements, scratch);
}

void follow_free_ends(const Rod& rod, const RodInputs& inputs, RodState& state) {
  const auto follow = [&](Hold hold, int node, int element, EndState& end) {
    if (hold == Hold::free || hold == Hold::guided) end.p_W = state.position[node];
    if (!joined(hold)) end.q_W = state.orientation[element];
  };
  follow(inputs.base.hold, rod.first, rod.first, state.base);
  follow(inputs.tip.hold, rod.elements, rod.elements - 1, state.tip);
}

void rest(const Rod& rod, const RodInputs& inputs, RodState& state) {
  halt(rod, state);
  follow_free_ends(rod, inputs, state);
  take_hold(inputs, state);
}

}  // namespace ostium::core
