#include "tests/support/nested_chains.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "tests/support/chain_descent.h"

namespace ostium::nested_chains {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double hold_N_m2 = 5e10;  // stiffness of a bore per length: 10 N on a node penetrate 0.4 um
constexpr test::ChainDescent how{1e-10, 0.05, 400};
constexpr int load_steps = 10;

Vector2d along(double angle) { return {std::cos(angle), std::sin(angle)}; }
Vector2d across(const Vector2d& t) { return {-t.y(), t.x()}; }

/// The angles of the outer chain's segments come first, then the inner's, each from the base.
class Pair {
 public:
  explicit Pair(const Problem& problem)
      : p_(problem),
        h_(problem.segment_m),
        m_(segments(problem.outer)),
        n_(segments(problem.inner)),
        angle_(VectorXd::Zero(m_ + n_)) {}

  Solution run() {
    Solution out;
    for (int k = 1; k <= load_steps; ++k) {  // steps in which curvatures and load grow
      part_ = static_cast<double>(k) / load_steps;
      out.converged = minimise();
      if (!out.converged) break;
    }
    out.outer = nodes(angle_, 0, m_), out.inner = nodes(angle_, m_, n_);
    return out;
  }

 private:
  int segments(const Tube& t) const { return static_cast<int>(std::lround(t.inserted_m / h_)); }

  static const Piece& piece(const Tube& t, double from_tip) {
    for (const Piece& p : t.pieces)
      if (from_tip < p.to_tip_m) return p;
    return t.pieces.back();
  }

  std::vector<Vector2d> nodes(const VectorXd& angle, int first, int count) const {
    std::vector<Vector2d> out(count + 1, Vector2d::Zero());
    for (int j = 0; j < count; ++j) out[j + 1] = out[j] + h_ * along(angle[first + j]);
    return out;
  }

  /// The position of an outer node relative to the inner line.
  struct Beside {
    int segment = 0;
    double part = 0, offset = 0;  ///< share along the segment; distance to its left
  };
  Beside beside(const Vector2d& q, int guess, const std::vector<Vector2d>& line, const VectorXd& angle) const {
    int j = std::clamp(guess, 0, n_ - 1);
    double part = 0;
    for (int tries = 0; tries < 50; ++tries) {
      part = along(angle[m_ + j]).dot(q - line[j]) / h_;
      const int next = part < 0 ? j - 1 : part > 1 ? j + 1 : j;
      if (next == j || next < 0 || next >= n_) break;
      j = next;
    }
    return {j, std::clamp(part, 0.0, 1.0), across(along(angle[m_ + j])).dot(q - line[j])};
  }

  struct Joint {
    double stiffness, rest;
  };
  /// Half a segment on either side, where there is one.
  Joint joint(const Tube& tube, int j) const {
    const double at = tube.inserted_m - j * h_;
    const Piece &ahead = piece(tube, at - h_ / 4), &behind = piece(tube, at + h_ / 4);
    const double half = h_ / 2, other = j == 0 ? 0 : half;
    return {1 / (half / ahead.EI_N_m2 + other / behind.EI_N_m2),
            part_ * (half * ahead.curvature_per_m + other * behind.curvature_per_m)};
  }

  double energy(const VectorXd& angle) const {
    double sum = 0;
    const auto bending = [&](const Tube& tube, int first, int count) {
      for (int j = 0; j < count; ++j) {
        const Joint k = joint(tube, j);
        const double bent = angle[first + j] - (j > 0 ? angle[first + j - 1] : 0) - k.rest;
        sum += k.stiffness * bent * bent / 2;
      }
    };
    bending(p_.outer, 0, m_), bending(p_.inner, m_, n_);
    const auto outer = nodes(angle, 0, m_), inner = nodes(angle, m_, n_);
    sum -= part_ * p_.tip_force_N.dot(inner.back());
    for (int i = 1; i <= m_; ++i) {
      const double deep = std::fabs(beside(outer[i], i, inner, angle).offset) - p_.play_m;
      if (deep > 0) sum += hold_N_m2 * h_ * deep * deep / 2;
    }
    return sum;
  }

  void linearise(VectorXd& gradient, MatrixXd& hessian) const {
    const int all = m_ + n_;
    gradient.setZero(all), hessian.setZero(all, all);
    const auto bending = [&](const Tube& tube, int first, int count) {
      for (int j = 0; j < count; ++j) {
        const Joint k = joint(tube, j);
        const int at = first + j;
        const double moment = k.stiffness * (angle_[at] - (j > 0 ? angle_[at - 1] : 0) - k.rest);
        gradient[at] += moment, hessian(at, at) += k.stiffness;
        if (j == 0) continue;
        gradient[at - 1] -= moment, hessian(at - 1, at - 1) += k.stiffness;
        hessian(at, at - 1) -= k.stiffness, hessian(at - 1, at) -= k.stiffness;
      }
    };
    bending(p_.outer, 0, m_), bending(p_.inner, m_, n_);
    const auto outer = nodes(angle_, 0, m_), inner = nodes(angle_, m_, n_);
    for (int j = 0; j < n_; ++j) {
      const Vector2d t = along(angle_[m_ + j]), F = part_ * p_.tip_force_N;
      gradient[m_ + j] -= h_ * F.dot(across(t)), hessian(m_ + j, m_ + j) += h_ * F.dot(t);
    }
    VectorXd lever(all);
    for (int i = 1; i <= m_; ++i) {
      const Beside b = beside(outer[i], i, inner, angle_);
      const double deep = std::fabs(b.offset) - p_.play_m;
      if (deep <= 0) continue;
      // Derivatives of the offset; its second derivatives are weighted by the small penetration and neglected.
      const Vector2d t = along(angle_[m_ + b.segment]), e = (b.offset > 0 ? 1 : -1) * across(t);
      lever.setZero();
      for (int j = 0; j < i; ++j) lever[j] = h_ * e.dot(across(along(angle_[j])));
      for (int j = 0; j < b.segment; ++j) lever[m_ + j] = -h_ * e.dot(across(along(angle_[m_ + j])));
      lever[m_ + b.segment] = -(b.offset > 0 ? 1 : -1) * t.dot(outer[i] - inner[b.segment]);
      gradient += hold_N_m2 * h_ * deep * lever;
      hessian += hold_N_m2 * h_ * lever * lever.transpose();
    }
  }

  bool minimise() {
    return test::descend(
        how, [this](const VectorXd& a) { return energy(a); },
        [this](VectorXd& gradient, MatrixXd& hessian) { linearise(gradient, hessian); }, angle_);
  }

  const Problem& p_;
  double h_, part_ = 1;
  int m_, n_;
  VectorXd angle_;
};

}  // namespace

Solution solve(const Problem& problem) { return Pair(problem).run(); }

}  // namespace ostium::nested_chains
