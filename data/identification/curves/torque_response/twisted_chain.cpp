#include "data/identification/curves/torque_response/twisted_chain.h"

#include <algorithm>
#include <cmath>

namespace ostium::data::torque_response {

namespace {

// rad a step, and where a wire may snap, so that it snaps from where it should
constexpr double most_turned = 0.3, most_turned_near_snap = 0.07;
constexpr double near_snap = 0.4;  // pull of a whole wire times its compliance; it has several angles at rest from 1
constexpr double most_step = 0.4;  // rad of Newton's method
constexpr double settled = 1e-9;   // rad
constexpr int most_changes = 100, most_newton = 60;

}  // namespace

TwistedChain::TwistedChain(std::vector<Node> nodes, double handed)
    : nodes_(std::move(nodes)), root_of_handed_(std::sqrt(handed)) {
  angle_ = Vector::Zero(static_cast<Eigen::Index>(nodes_.size()));
  state_.resize(nodes_.size(), State::stands);
  double compliance = 0, unsteady = 0;
  spring_.resize(angle_.size());
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const double pull = std::hypot(nodes_[k].pull_Nm[0], nodes_[k].pull_Nm[1]);
    spring_[static_cast<Eigen::Index>(k)] = 1 / nodes_[k].compliance;
    compliance += nodes_[k].compliance, unsteady += pull * compliance, pulled_ = pulled_ || pull > 0;
  }
  most_turned_ = unsteady > near_snap ? most_turned_near_snap : most_turned;
  settle(angle_);
}

double TwistedChain::stiffness(Eigen::Index spring) const {
  return twist(spring) > 0 ? spring_[spring] * root_of_handed_ : spring_[spring] / root_of_handed_;
}

/// What springs and pull turn a node with, without friction.
double TwistedChain::net(Eigen::Index i) const {
  const Node& node = nodes_[static_cast<std::size_t>(i)];
  double out = stiffness(i) * twist(i);
  if (i + 1 < angle_.size()) out -= stiffness(i + 1) * twist(i + 1);
  if (pulled_) out += node.pull_Nm[1] * std::cos(angle_[i]) - node.pull_Nm[0] * std::sin(angle_[i]);
  return out;
}

/// The same, less friction where it slips.
double TwistedChain::free_of(Eigen::Index i) const {
  const auto k = static_cast<std::size_t>(i);
  const double side = state_[k] == State::slips_up ? 1 : -1;
  return net(i) - side * nodes_[k].most_Nm;
}

bool TwistedChain::relax() {
  const Eigen::Index n = angle_.size();
  Vector diagonal(n), beside(n), step(n);
  for (int iteration = 0; iteration < most_newton; ++iteration) {
    for (const bool convex : {false, true}) {
      bool stable = true;
      // Thomas's algorithm for the symmetric matrix; nodes that stand have a row of the unit matrix.
      for (Eigen::Index i = 0; i < n && stable; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (state_[k] == State::stands) {
          diagonal[i] = 1, beside[i] = 0, step[i] = 0;
          continue;
        }
        const double own = stiffness(i), next = i + 1 < n ? stiffness(i + 1) : 0;
        const Node& node = nodes_[k];
        double pull = 0;
        if (pulled_) pull = node.pull_Nm[0] * std::cos(angle_[i]) + node.pull_Nm[1] * std::sin(angle_[i]);
        diagonal[i] = own + next + (convex ? std::max(pull, 0.0) : pull);
        beside[i] = i + 1 < n && state_[k + 1] != State::stands ? -next : 0;
        step[i] = free_of(i);
        if (i > 0 && beside[i - 1] != 0) {
          const double factor = beside[i - 1] / diagonal[i - 1];
          diagonal[i] -= factor * beside[i - 1], step[i] -= factor * step[i - 1];
        }
        stable = diagonal[i] > 1e-3 * (own + next);
      }
      if (stable || convex) break;
    }
    for (Eigen::Index i = n; i-- > 0;) {
      if (i + 1 < n) step[i] -= beside[i] * step[i + 1];
      step[i] /= diagonal[i];
    }
    const double size = step.cwiseAbs().maxCoeff();
    angle_ += step * std::min(1.0, most_step / std::max(size, most_step));
    if (size < settled) return true;
  }
  return false;
}

/// Lets nodes slip that are pulled with more than friction holds, and stand that would slip against it.
void TwistedChain::settle(const Vector& before) {
  if (angle_.size() == 0) return;
  for (std::size_t k = 0; k < nodes_.size(); ++k) state_[k] = nodes_[k].most_Nm > 0 ? State::stands : State::slips_up;
  for (int change = 0; change < most_changes; ++change) {
    relax();
    bool again = false;
    for (Eigen::Index i = 0; i < angle_.size(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double most = nodes_[k].most_Nm;
      if (most <= 0) continue;
      if (state_[k] == State::stands) {
        const double pulled = net(i);
        if (std::fabs(pulled) <= most * (1 + 1e-9)) continue;
        state_[k] = pulled > 0 ? State::slips_up : State::slips_down, again = true;
      } else if ((angle_[i] - before[i]) * (state_[k] == State::slips_up ? 1 : -1) < -10 * settled) {
        state_[k] = State::stands, angle_[i] = before[i], again = true;
      }
    }
    if (!again) return;
  }
}

void TwistedChain::turn(double proximal_rad) {
  const double from = proximal_, by = proximal_rad - from;
  const int steps = pulled_ ? std::max(1, static_cast<int>(std::ceil(std::fabs(by) / most_turned_))) : 1;
  for (int k = 1; k <= steps; ++k) {
    const Vector before = angle_;
    proximal_ = from + by * k / steps;
    settle(before);
  }
}

double TwistedChain::distal_rad() const { return angle_.size() > 0 ? angle_[angle_.size() - 1] : proximal_; }

double TwistedChain::torque_Nm() const { return angle_.size() > 0 ? stiffness(0) * twist(0) : 0; }

}  // namespace ostium::data::torque_response
