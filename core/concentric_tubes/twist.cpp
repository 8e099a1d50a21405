#include "core/concentric_tubes/twist.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/tolerances.h"

namespace ostium::core {

namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

Vector2d turned(double angle, const Vector2d& k) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * k.x() - s * k.y(), s * k.x() + c * k.y()};
}
Vector2d quarter_turned(const Vector2d& k) { return {-k.y(), k.x()}; }

/// Angle of a part on one side of a joint as a sum of unknowns: that of an element, or b_i - b_ref at the base.
struct Angle {
  int plus = -1, minus = -1;  ///< unknowns; -1: none
  double value(const VectorXd& x) const { return (plus < 0 ? 0 : x[plus]) - (minus < 0 ? 0 : x[minus]); }
};

class Twist {
 public:
  Twist(const Concentric& nest, const ConcentricState& state) : nest_(nest), moment_(state.moment_N_m) {
    n_ = static_cast<int>(nest.parts.size());
    N_ = nest.carrier.rods[0].elements;
    unknowns_ = n_;
    index_.setConstant(n_, N_, -1);
    for (int j = 0; j < N_; ++j)
      for (int i = 0; i < n_; ++i)
        if (i != nest.reference && j <= nest.last_element[i]) index_(i, j) = unknowns_++;
  }

  VectorXd gather(const ConcentricState& state) const {
    VectorXd x(unknowns_);
    x.head(n_) = state.base_roll_rad;
    for (int j = 0; j < N_; ++j)
      for (int i = 0; i < n_; ++i)
        if (index_(i, j) >= 0) x[index_(i, j)] = state.roll_rad(i, j);
    return x;
  }

  void scatter(const VectorXd& x, ConcentricState& state) const {
    state.base_roll_rad = x.head(n_);
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < N_; ++j) state.roll_rad(i, j) = side(i, std::min(j, nest_.last_element[i])).value(x);
  }

  /// Angle of a part in element j; j = -1: at the base.
  Angle side(int part, int j) const {
    if (part == nest_.reference) return {};
    if (j < 0) return {part, nest_.reference};
    return {index_(part, j), -1};
  }

  /// Rest curvature of the carrier at joint k.
  Eigen::Vector3d rest_curvature(const VectorXd& x, int k) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const ConcentricPiece& piece : nest_.pieces[k])
      for (const auto& member : piece.members)
        sum.head<2>() += piece.length_m / piece.EI_N_m2 *
                         turned(angle(x, member.part, k), member.EI_N_m2 * member.rest_curvature_per_m);
    for (int i = 0; i < n_; ++i)
      if (i != nest_.reference && k <= nest_.last_element[i])
        sum.z() -= nest_.GJ_N_m2(i, k) / nest_.GJ_N_m2.col(k).sum() * (side(i, k).value(x) - side(i, k - 1).value(x));
    return sum / nest_.carrier.rods[0].joint_length.at(0)[k];
  }

  /// Turns the parts slightly against each other, more with distance from the base, to leave a balanced but unstable
  /// state such as two tubes bent straight against each other.
  void disturb(VectorXd& x) const {
    for (int j = 0; j < N_; ++j)
      for (int i = 0; i < n_; ++i)
        if (index_(i, j) >= 0) x[index_(i, j)] += 1e-3 * (j + 1) / N_;
  }

  /// The energy, and its gradient and Hessian if requested.
  double energy(const VectorXd& x, VectorXd* gradient, Eigen::SparseMatrix<double>* hessian) const {
    Sum sum{0, gradient, {}};
    if (gradient) gradient->setZero(unknowns_);
    shafts(x, sum);
    for (int k = 0; k < N_ && n_ > 1; ++k) {
      twist(x, k, sum);
      bend(x, k, sum);
    }
    if (hessian) {
      hessian->resize(unknowns_, unknowns_);
      hessian->setFromTriplets(sum.entries.begin(), sum.entries.end());
    }
    return sum.energy;
  }

 private:
  struct Sum {
    double energy;
    VectorXd* gradient;
    std::vector<Eigen::Triplet<double>> entries;

    void slope(const Angle& a, double by) {
      if (!gradient) return;
      if (a.plus >= 0) (*gradient)[a.plus] += by;
      if (a.minus >= 0) (*gradient)[a.minus] -= by;
    }
    void curve(const Angle& a, const Angle& b, double by) {
      if (!gradient) return;
      const auto add = [&](int r, int c, double value) {
        if (r >= 0 && c >= 0) entries.emplace_back(r, c, value);
      };
      add(a.plus, b.plus, by), add(a.minus, b.minus, by), add(a.plus, b.minus, -by), add(a.minus, b.plus, -by);
    }
  };

  void shafts(const VectorXd& x, Sum& sum) const {
    for (int i = 0; i < n_; ++i) {
      const ConcentricPart& part = nest_.parts[i];
      // A rigid shaft is modelled as far stiffer than a millimetre of the instrument.
      const double stiffness = 1 / std::max(part.shaft_rad_per_Nm, 1e-8 / part.sections.back().GJ_N_m2);
      const double off = x[i] - part.roll_rad;
      sum.energy += stiffness * off * off / 2;
      sum.slope({i, -1}, stiffness * off);
      sum.curve({i, -1}, {i, -1}, stiffness);
    }
    sum.energy -= moment_(2, 0) * x[nest_.reference];
    sum.slope({nest_.reference, -1}, -moment_(2, 0));
  }

  void twist(const VectorXd& x, int k, Sum& sum) const {
    const double length = nest_.carrier.rods[0].joint_length.at(0)[k];
    const double whole = nest_.GJ_N_m2.col(k).sum() / length;
    double torque = -moment_(2, k);
    const auto each = [&](auto&& f) {
      for (int i = 0; i < n_; ++i)
        if (i != nest_.reference && k <= nest_.last_element[i]) f(i, side(i, k - 1), side(i, k));
    };
    each([&](int i, Angle a, Angle b) { torque += nest_.GJ_N_m2(i, k) / length * (b.value(x) - a.value(x)); });
    sum.energy -= torque * torque / (2 * whole);
    each([&](int i, Angle a, Angle b) {
      const double g = nest_.GJ_N_m2(i, k) / length, turn = b.value(x) - a.value(x);
      sum.energy += g * turn * turn / 2;
      const double slope = g * turn - g * torque / whole;
      sum.slope(b, slope), sum.slope(a, -slope);
      each([&](int j, Angle c, Angle d) {
        const double curve = (i == j ? g : 0) - g * nest_.GJ_N_m2(j, k) / length / whole;
        sum.curve(b, d, curve), sum.curve(a, c, curve), sum.curve(a, d, -curve), sum.curve(b, c, -curve);
      });
    });
  }

  void bend(const VectorXd& x, int k, Sum& sum) const {
    const Vector2d moment = moment_.col(k).head<2>();
    for (const ConcentricPiece& piece : nest_.pieces[k]) {
      std::vector<Vector2d> own(piece.members.size());
      Vector2d total = moment;
      for (std::size_t m = 0; m < own.size(); ++m) {
        const auto& member = piece.members[m];
        own[m] = turned(angle(x, member.part, k), member.EI_N_m2 * member.rest_curvature_per_m);
        total += own[m];
      }
      const double scale = piece.length_m / piece.EI_N_m2;
      sum.energy -= scale * total.squaredNorm() / 2;
      if (!sum.gradient) continue;
      for (std::size_t m = 0; m < own.size(); ++m) {
        const int i = piece.members[m].part;
        if (i == nest_.reference || own[m].isZero()) continue;
        slope_of_mean(i, k, -scale * total.dot(quarter_turned(own[m])), sum);
        for (std::size_t l = 0; l < own.size(); ++l) {
          const int j = piece.members[l].part;
          if (j == nest_.reference || own[l].isZero()) continue;
          double curve = -scale * own[m].dot(own[l]);
          if (m == l) curve += scale * total.dot(own[m]);
          curve_of_mean(i, j, k, curve, sum);
        }
      }
    }
  }

  /// Number of sides of joint k over which a part's angle is averaged: both, or only the proximal one at its tip.
  int sides(int part, int k) const { return part == nest_.reference || k <= nest_.last_element[part] ? 2 : 1; }
  double angle(const VectorXd& x, int part, int k) const {
    const double before = side(part, k - 1).value(x);
    return sides(part, k) == 1 ? before : 0.5 * (before + side(part, k).value(x));
  }
  void slope_of_mean(int part, int k, double by, Sum& sum) const {
    const int count = sides(part, k);
    for (int a = 0; a < count; ++a) sum.slope(side(part, k - 1 + a), by / count);
  }
  void curve_of_mean(int i, int j, int k, double by, Sum& sum) const {
    const int ni = sides(i, k), nj = sides(j, k);
    for (int a = 0; a < ni; ++a)
      for (int b = 0; b < nj; ++b) sum.curve(side(i, k - 1 + a), side(j, k - 1 + b), by / (ni * nj));
  }

  const Concentric& nest_;
  const Eigen::Matrix3Xd& moment_;
  int n_ = 0, N_ = 0, unknowns_ = 0;
  Eigen::MatrixXi index_;  ///< (#parts, #elements): unknown, -1 if none; numbered along the rod, for a narrow matrix
};

}  // namespace

TwistSolution solve_twist(const Concentric& nest, ConcentricState& state) {
  const Twist twist(nest, state);
  VectorXd x = twist.gather(state), gradient;
  const VectorXd start = x;
  Eigen::SparseMatrix<double> hessian;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> factors;
  TwistSolution out;
  out.converged = false;
  double energy = twist.energy(x, &gradient, &hessian), shift = 0;
  const double typical = hessian.diagonal().cwiseAbs().maxCoeff();
  for (int iteration = 0; iteration < tolerances::max_static_iterations && !out.converged; ++iteration) {
    factors.setShift(shift);
    factors.compute(hessian);
    if (factors.info() != Eigen::Success || (factors.vectorD().array() <= 0).any()) {  // not a descent direction
      if (gradient.cwiseAbs().maxCoeff() < 1e-12 * typical) {
        twist.disturb(x);
        energy = twist.energy(x, &gradient, &hessian);
      }
      shift = std::max(1e-9 * typical, 4 * shift);
      continue;
    }
    VectorXd step = -factors.solve(gradient);
    const double longest = step.cwiseAbs().maxCoeff();
    if (longest > tolerances::max_turn_rad) step *= tolerances::max_turn_rad / longest;
    out.converged = shift == 0 && longest < tolerances::concentric_tolerance_rad / 100;
    // Near the minimum, energies differ by less than rounding.
    const double needed = longest < 1e-5 ? std::numeric_limits<double>::infinity() : energy;
    double part = 1, tried = 0;
    while ((tried = twist.energy(x + part * step, nullptr, nullptr)) > needed && part > 1e-6) part /= 2;
    x += part * step;
    energy = twist.energy(x, &gradient, &hessian);
    shift = longest > 1e-3 ? shift / 16 : 0;
    if (shift < 1e-10 * typical) shift = 0;
  }
  out.turn_rad = (x - start).cwiseAbs().maxCoeff();
  if (out.converged) twist.scatter(x, state);
  return out;
}

void set_concentric_rest_curvature(const Concentric& nest, const ConcentricState& state, Rod& rod) {
  const Twist twist(nest, state);
  const VectorXd x = twist.gather(state);
  for (int k = 0; k < static_cast<int>(nest.pieces.size()); ++k) rod.rest_curvature.set(k, twist.rest_curvature(x, k));
}
}  // namespace ostium::core
