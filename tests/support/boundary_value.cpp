#include "tests/support/boundary_value.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace ostium::boundary_value {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// y = (p, R column by column, m world [sum of all tubes], then per tube: angle relative to the frame, twist rate). The
/// frame R has no twist of its own: a tube's material frame is R Rz(angle).
class Shooter {
 public:
  Shooter(const Problem& p, double amount) : p_(p), amount_(amount), n_(static_cast<int>(p.tubes.size())) {
    for (const Tube& t : p.tubes) {
      length_ = std::max(length_, t.inserted_m);
      for (const core::Section& s : t.sections)
        for (double at : {t.inserted_m - s.from_tip_m, t.inserted_m - s.to_tip_m}) stops_.push_back(at);
    }
    for (const Load& l : p.loads) stops_.insert(stops_.end(), {l.from_base_m, l.to_base_m});
    std::erase_if(stops_, [&](double x) { return x <= 1e-12 || x > length_; });
    std::sort(stops_.begin(), stops_.end());
    stops_.erase(std::unique(stops_.begin(), stops_.end(), [](double a, double b) { return b - a < 1e-12; }),
                 stops_.end());
  }

  int size() const { return 15 + 2 * n_; }

  /// unknown: bending moment (2, in base_R) and the torque of each tube at the base.
  VectorXd start(const VectorXd& unknown) const {
    VectorXd y = VectorXd::Zero(size());
    y.head<3>() = p_.base_p;
    Eigen::Map<Matrix3d>(y.data() + 3) = p_.base_R;
    double torque = 0;
    for (int i = 0; i < n_; ++i) {
      const Tube& t = p_.tubes[i];
      y[15 + i] = t.roll_rad + t.shaft_rad_per_Nm * unknown[2 + i];
      y[15 + n_ + i] = unknown[2 + i];  // its torque
      torque += unknown[2 + i];
    }
    y.segment<3>(12) = p_.base_R * Vector3d(unknown[0], unknown[1], torque);
    return y;
  }

  /// Integrates to the far end; returns the conditions that should vanish there and, if asked for, points on the way.
  VectorXd shoot(const VectorXd& unknown, int points, Solution* out) {
    VectorXd y = start(unknown), miss = VectorXd::Zero(2 + n_);
    std::vector<double> targets = stops_;
    for (int i = 0; out && i < points; ++i) targets.push_back(length_ * i / (points - 1));
    std::sort(targets.begin(), targets.end());
    double s = 0;
    next_ = 0;
    int taken = 0;
    for (double target : targets) {
      while (next_ < stops_.size() && stops_[next_] < target - 1e-12) ++next_;
      if (target > s + 1e-13) advance(s, target, y);
      s = std::max(s, target);
      if (out && taken < points && std::fabs(target - length_ * taken / (points - 1)) < 1e-13) {
        out->curve.push_back(y.head<3>());
        ++taken;
      }
      for (int i = 0; i < n_; ++i) {
        if (std::fabs(p_.tubes[i].inserted_m - target) > 1e-12 || ended(i, target - 1e-9)) continue;
        miss[2 + i] = y[15 + n_ + i];
        if (out && i == n_ - 1) {
          const Matrix3d R = Eigen::Map<Matrix3d>(y.data() + 3);
          out->tip_R = R * Eigen::AngleAxisd(y[15 + i], Vector3d::UnitZ()).toRotationMatrix();
        }
      }
    }
    const Matrix3d R = Eigen::Map<Matrix3d>(y.data() + 3);
    miss.head<2>() = (R.transpose() * y.segment<3>(12)).head<2>();
    return miss;
  }

 private:
  bool ended(int i, double s) const { return s >= p_.tubes[i].inserted_m; }

  const core::Section& section(int i, double s) const {
    const Tube& t = p_.tubes[i];
    for (const core::Section& c : t.sections)
      if (t.inserted_m - s < c.to_tip_m) return c;
    return t.sections.back();
  }

  /// Weight and load distal to s.
  Vector3d force(double s) const {
    Vector3d f = p_.tip_force;
    for (const Tube& t : p_.tubes)
      for (const core::Section& c : t.sections) {
        const double from = std::max(s, t.inserted_m - c.to_tip_m), to = t.inserted_m - c.from_tip_m;
        if (to > from) f += c.kg_per_m * (to - from) * p_.gravity;
      }
    for (const Load& l : p_.loads) {
      const double length = l.to_base_m - l.from_base_m;
      if (length <= 0)
        f += l.from_base_m > s ? l.force : Vector3d::Zero().eval();
      else if (l.to_base_m > s)
        f += l.force * (l.to_base_m - std::max(s, l.from_base_m)) / length;
    }
    return amount_ * f;
  }

  /// Curvature beyond rest for a bending moment: inverts the softening law by Newton's method on the remaining share of
  /// the linear moment.
  static Vector2d curvature_of(const core::Section& c, const Vector2d& moment) {
    Vector2d k(moment.x() / c.EI1_N_m2, moment.y() / c.EI2_N_m2);
    if (c.softening_per_m <= 0 || c.softened_ratio >= 1) return k;
    // k = k_linear / part(k): the only unknown, the part, lies between the ratio and 1.
    const double mean = 0.5 * (c.EI1_N_m2 + c.EI2_N_m2), r = c.softened_ratio;
    const double q =
        (c.EI1_N_m2 * k.x() * k.x() + c.EI2_N_m2 * k.y() * k.y()) / mean / c.softening_per_m / c.softening_per_m;
    double low = r, high = 1;
    for (int i = 0; i < 60; ++i) {
      const double part = 0.5 * (low + high);
      (r + (1 - r) / std::sqrt(1 + q / (part * part)) > part ? low : high) = part;
    }
    return k / (0.5 * (low + high));
  }

  static int slope(double s, const double y[], double dy[], void* self) {
    static_cast<const Shooter*>(self)->derivative(s, y, dy);
    return GSL_SUCCESS;
  }

  void derivative(double s, const double y[], double dy[]) const {
    const Eigen::Map<const Matrix3d> R(y + 3);
    const Eigen::Map<const Vector3d> m(y + 12);
    const double middle = 0.5 * (from_ + to_);  // constant between two stops
    if (n_ == 1) return alone(s, y, dy, middle);
    Vector2d pull = (R.transpose() * m).head<2>();
    double EI = 0;
    for (int i = 0; i < n_; ++i) {
      if (ended(i, middle)) continue;
      const core::Section& c = section(i, middle);
      EI += c.EI1_N_m2;
      const Vector2d k = amount_ * c.rest_curvature_per_m.head<2>();
      pull += c.EI1_N_m2 * (Eigen::Rotation2Dd(y[15 + i]) * k);
    }
    const Vector3d u(pull.x() / EI, pull.y() / EI, 0);
    Eigen::Map<Vector3d>(dy + 0) = R.col(2);
    const Vector3d u_W = R * u;
    for (int c = 0; c < 3; ++c) Eigen::Map<Vector3d>(dy + 3 + 3 * c) = u_W.cross(Vector3d(R.col(c)));
    Eigen::Map<Vector3d>(dy + 12) = -Vector3d(R.col(2)).cross(force(s));
    for (int i = 0; i < n_; ++i) {
      dy[15 + i] = dy[15 + n_ + i] = 0;
      if (ended(i, middle)) continue;
      const core::Section& c = section(i, middle);
      const Vector2d k = Eigen::Rotation2Dd(y[15 + i]) * Vector2d(amount_ * c.rest_curvature_per_m.head<2>());
      dy[15 + i] = y[15 + n_ + i] / c.GJ_N_m2;
      // m_z' = -(u x m)_z of the tube's own bending moment m = EI (u - k).
      dy[15 + n_ + i] = c.EI1_N_m2 * (u.x() * k.y() - u.y() * k.x());
    }
  }

  /// A single instrument may have different bending stiffnesses about its two axes, soften, and be twisted at rest.
  void alone(double s, const double y[], double dy[], double middle) const {
    const Eigen::Map<const Matrix3d> R(y + 3);
    const Eigen::Map<const Vector3d> m_W(y + 12);
    const core::Section& c = section(0, middle);
    const Vector3d m = R.transpose() * m_W, rest = amount_ * c.rest_curvature_per_m;
    const Eigen::Rotation2Dd turn(y[15]);
    const Vector2d own = turn.inverse() * Vector2d(m.head<2>());
    Vector2d beyond = curvature_of(c, own);
    if (p_.tubes[0].more_curved) beyond *= p_.tubes[0].more_curved(beyond.norm());
    const Vector2d u = turn * Vector2d(beyond + rest.head<2>());
    Eigen::Map<Vector3d>(dy + 0) = R.col(2);
    const Vector3d u_W = R * Vector3d(u.x(), u.y(), 0);
    for (int k = 0; k < 3; ++k) Eigen::Map<Vector3d>(dy + 3 + 3 * k) = u_W.cross(Vector3d(R.col(k)));
    Eigen::Map<Vector3d>(dy + 12) = -Vector3d(R.col(2)).cross(force(s));
    dy[15] = y[16] / c.GJ_N_m2 + rest.z();
    dy[16] = u.y() * m.x() - u.x() * m.y();
  }

  void advance(double from, double to, VectorXd& y) {
    from_ = from, to_ = to;
    gsl_odeiv2_system system{slope, nullptr, static_cast<std::size_t>(size()), this};
    gsl_odeiv2_driver* driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, (to - from) / 4, 1e-12, 1e-11);
    double s = from;
    gsl_odeiv2_driver_apply(driver, &s, to, y.data());
    gsl_odeiv2_driver_free(driver);
  }

  const Problem& p_;
  double amount_;
  int n_;
  double length_ = 0, from_ = 0, to_ = 0;
  std::size_t next_ = 0;
  std::vector<double> stops_;
};

}  // namespace

Solution solve(const Problem& problem, int points, int stages) {
  const int n = static_cast<int>(problem.tubes.size());
  VectorXd x = VectorXd::Zero(2 + n);
  double scale = 0;  // reference moment for comparison
  for (const Tube& t : problem.tubes) scale = std::max(scale, t.sections.back().EI1_N_m2);
  Solution out;
  for (int stage = 1; stage <= stages; ++stage) {
    Shooter shooter(problem, static_cast<double>(stage) / stages);
    out.converged = false;
    for (int iteration = 0; iteration < 60 && !out.converged; ++iteration) {
      const VectorXd miss = shooter.shoot(x, 0, nullptr);
      Eigen::MatrixXd J(2 + n, 2 + n);
      const double h = 1e-6 * scale;
      for (int c = 0; c < 2 + n; ++c) {
        VectorXd up = x, down = x;
        up[c] += h, down[c] -= h;
        J.col(c) = (shooter.shoot(up, 0, nullptr) - shooter.shoot(down, 0, nullptr)) / (2 * h);
      }
      VectorXd step = -J.fullPivLu().solve(miss);
      out.mismatch = miss.cwiseAbs().maxCoeff();
      double part = 1;
      while (part > 1e-3 && shooter.shoot(x + part * step, 0, nullptr).norm() > (1 - 0.1 * part) * miss.norm() &&
             out.mismatch > 1e-9 * scale)
        part /= 2;
      x += part * step;
      out.converged = out.mismatch < 1e-8 * scale;
    }
    if (!out.converged) return out;
  }
  Shooter(problem, 1).shoot(x, points, &out);
  return out;
}

}  // namespace ostium::boundary_value
