#include "data/identification/minimisation/secant_descent.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/dense.h"

namespace ostium::data {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double free_step = 1e-4;  // finite-difference step of the free numbers, in scales
constexpr double good = 0.7, bad = 0.1, shrink = 0.4, near_enough = 2;

class SecantSearch {
 public:
  explicit SecantSearch(const SecantDescent& d) : d_(d), m_(d.dear), n_(static_cast<int>(d.problem.start.size())) {
    low_ = (d.problem.least - d.problem.start).cwiseQuotient(d.scale);
    high_ = (d.problem.most - d.problem.start).cwiseQuotient(d.scale);
  }

  LeastSquaresResult run() {
    LeastSquaresResult out;
    out.x = d_.problem.start;
    at_ = VectorXd::Zero(n_);
    out.cost = cost_ = evaluate(at_, r_);
    out.iterations = evaluations_;
    if (!std::isfinite(cost_) || !begin()) return out;
    double radius = d_.first_radius;
    while (evaluations_ < d_.most_evaluations) {
      if (!model()) break;
      double gain = 0;
      const VectorXd p = step(radius, gain);
      const double least_gain = std::max(d_.least_gain, 1e-4 * cost_);
      if (gain < least_gain) {
        // Trusted only if the points of the model are close.
        if (radius <= d_.last_radius) {
          out.converged = true;
          break;
        }
        radius = std::max(shrink * radius, d_.last_radius);
        improve(radius);
        continue;
      }
      VectorXd r;
      const VectorXd to = at_ + p;
      const double cost = evaluate(to, r), ratio = (cost_ - cost) / gain;
      const double went = p.head(m_).norm();
      const bool far = farthest() > near_enough * std::max(radius, d_.last_radius);
      add(to, r, cost);
      if (ratio > good) {
        radius = std::max(radius, 2 * went);
      } else if (ratio < bad) {
        if (far && improve(radius)) continue;
        radius = std::min(radius, std::max(went, 0.1 * radius)) * shrink;
        if (radius < 0.1 * d_.last_radius) {
          out.converged = true;
          break;
        }
      }
    }
    out.x = d_.problem.start + at_.cwiseProduct(d_.scale);
    out.cost = cost_, out.iterations = evaluations_;
    return out;
  }

 private:
  double evaluate(const VectorXd& u, VectorXd& r) {
    ++evaluations_;
    return seen(u, r);
  }
  /// Residuals at u without counting an evaluation: the dear numbers have been here before.
  double seen(const VectorXd& u, VectorXd& r) const {
    const VectorXd x =
        (d_.problem.start + u.cwiseProduct(d_.scale)).cwiseMax(d_.problem.least).cwiseMin(d_.problem.most);
    if (!d_.problem.evaluate(x, r, nullptr)) return std::numeric_limits<double>::infinity();
    return r.squaredNorm() / 2;
  }

  /// Evaluates the first points, one along each dear number.
  bool begin() {
    const VectorXd from = at_;
    for (int i = 0; i < m_; ++i) {
      bool found = false;
      for (const double part : {1.0, -1.0, 0.3, -0.3}) {
        VectorXd to = from, r;
        to[i] = std::clamp(from[i] + part * d_.first_step, low_[i], high_[i]);
        if (std::fabs(to[i] - from[i]) < 0.2 * d_.first_step) continue;
        const double cost = evaluate(to, r);
        if (!std::isfinite(cost)) continue;
        others_.push_back(to.head(m_));
        found = true;
        break;
      }
      if (!found) return false;
    }
    return true;
  }

  MatrixXd offsets() const {
    MatrixXd D(m_, m_);
    for (int k = 0; k < m_; ++k) D.col(k) = others_[k] - at_.head(m_);
    return D;
  }
  double farthest() const { return m_ > 0 ? offsets().colwise().norm().maxCoeff() : 0; }

  /// Sets J_, the Jacobian of `r_` at `at_`.
  bool model() {
    J_.resize(r_.size(), n_);
    MatrixXd change(r_.size(), m_);
    VectorXd r;
    for (int k = 0; k < m_; ++k) {
      VectorXd u = at_;
      u.head(m_) = others_[k];
      if (!std::isfinite(seen(u, r))) return false;
      change.col(k) = r - r_;
    }
    J_.leftCols(m_) = core::least_squares_of_columns(offsets().transpose(), change.transpose()).transpose();
    for (int i = m_; i < n_; ++i) {
      VectorXd u = at_;
      u[i] += at_[i] + free_step > high_[i] ? -free_step : free_step;
      if (!std::isfinite(seen(u, r))) return false;
      J_.col(i) = (r - r_) / (u[i] - at_[i]);
    }
    return J_.allFinite();
  }

  /// The step to the minimum of the linear model, within the bounds and, for the dear numbers, the radius.
  VectorXd step(double radius, double& gain) const {
    VectorXd p = VectorXd::Zero(n_);
    std::vector<bool> held(n_, false);
    for (int pass = 0; pass <= n_; ++pass) {
      std::vector<int> moving;
      for (int i = 0; i < n_; ++i)
        if (!held[i]) moving.push_back(i);
      const int count = static_cast<int>(moving.size());
      if (count == 0) break;
      VectorXd r = r_;
      double used = 0;
      for (int i = 0; i < n_; ++i)
        if (held[i]) r += J_.col(i) * p[i], used += i < m_ ? p[i] * p[i] : 0;
      MatrixXd A(r.size(), count);
      VectorXd dear(count);
      for (int j = 0; j < count; ++j) A.col(j) = J_.col(moving[j]), dear[j] = moving[j] < m_ ? 1 : 0;
      const MatrixXd H = A.transpose() * A;
      const VectorXd g = A.transpose() * r;
      const double left = std::sqrt(std::max(radius * radius - used, 1e-6 * radius * radius));
      const double small = 1e-12 * std::max(H.diagonal().maxCoeff(), 1e-12);
      const auto at = [&](double damping) -> VectorXd {
        MatrixXd K = H;
        K.diagonal() += damping * dear + VectorXd::Constant(count, small);
        return -core::solve_symmetric(K, g);
      };
      VectorXd q = at(0);
      if (q.cwiseProduct(dear).norm() > left) {
        double less = 1e-12 * (small / 1e-12), more = std::max(H.trace(), 1e-12);
        while (at(more).cwiseProduct(dear).norm() > left) more *= 10;
        for (int i = 0; i < 60; ++i) {
          const double middle = std::sqrt(less * more);
          (at(middle).cwiseProduct(dear).norm() > left ? less : more) = middle;
        }
        q = at(more);
      }
      bool over = false;
      for (int j = 0; j < count; ++j) {
        const int i = moving[j];
        p[i] = std::clamp(q[j], low_[i] - at_[i], high_[i] - at_[i]);
        if (p[i] != q[j]) held[i] = over = true;
      }
      if (!over) break;
    }
    gain = cost_ - (r_ + J_ * p).squaredNorm() / 2;
    return p;
  }

  /// Adds a point to the model, replacing the least useful one; if it is better than the centre, it becomes the centre.
  void add(const VectorXd& u, const VectorXd& r, double cost) {
    if (!std::isfinite(cost)) return;
    const VectorXd share = core::least_squares(offsets(), u.head(m_) - at_.head(m_));
    int out = -1;
    double most = 1e-3;  // below this the point would degrade the model
    for (int k = 0; k < m_; ++k) {
      const double far = (others_[k] - u.head(m_)).norm();
      const double weight = std::fabs(share[k]) * std::max(1.0, far * far / (d_.last_radius * d_.last_radius));
      if (weight > most) most = weight, out = k;
    }
    if (cost < cost_) {
      if (out >= 0) others_[out] = at_.head(m_);
      at_ = u, r_ = r, cost_ = cost;
    } else if (out >= 0) {
      others_[out] = u.head(m_);
    }
  }

  /// Replaces the farthest point by a near one, perpendicular to the others. False if all points are near.
  bool improve(double radius) {
    const MatrixXd D = offsets();
    int k = 0;
    if (m_ == 0 || D.colwise().norm().maxCoeff(&k) <= near_enough * radius) return false;
    VectorXd across = D.col(k);
    if (m_ > 1) {
      MatrixXd rest(m_, m_ - 1);
      for (int j = 0, c = 0; j < m_; ++j)
        if (j != k) rest.col(c++) = D.col(j);
      across = core::perpendicular_to_columns(rest);
    }
    across.normalize();
    if (J_.size() > 0 && (J_.leftCols(m_).transpose() * r_).dot(across) > 0) across = -across;
    for (const double sign : {1.0, -1.0}) {
      VectorXd to = at_, r;
      to.head(m_) += sign * radius * across;
      to = to.cwiseMax(low_).cwiseMin(high_);
      if ((to - at_).norm() < 0.5 * radius) continue;
      const double cost = evaluate(to, r);
      if (!std::isfinite(cost)) continue;
      others_[k] = to.head(m_);
      if (cost < cost_) {
        others_[k] = at_.head(m_);
        at_ = to, r_ = r, cost_ = cost;
      }
      return true;
    }
    return false;
  }

  const SecantDescent& d_;
  const int m_, n_;
  VectorXd low_, high_;  ///< this and all below in units of scale, relative to the start
  VectorXd at_, r_;
  double cost_ = 0;
  std::vector<VectorXd> others_;  ///< dear numbers of the model's other points
  MatrixXd J_;
  int evaluations_ = 0;
};

}  // namespace

LeastSquaresResult minimise(const SecantDescent& descent) { return SecantSearch(descent).run(); }

}  // namespace ostium::data
