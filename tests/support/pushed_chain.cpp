#include "tests/support/pushed_chain.h"

#include <Eigen/Dense>
#include <cmath>

#include "tests/support/chain_descent.h"

namespace ostium::pushed_chain {

namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double smooth_m = 0.5e-6;  // friction: smaller displacements count as sticking
constexpr test::ChainDescent how{};
constexpr int most_rounds = 60;
constexpr double force_tolerance = 1e-3;  // relative to the largest wall force

Vector2d along(double angle) { return {std::cos(angle), std::sin(angle)}; }
Vector2d across(const Vector2d& t) { return {-t.y(), t.x()}; }

/// Offset from the centreline: distance, direction, and the rate at which the direction turns along the tube.
struct Offset {
  double distance = 0;  ///< >= 0
  Vector2d outwards = Vector2d::UnitY(), tangent = Vector2d::UnitX();
  double bend_per_m = 0;  ///< of the line at that distance: > 0 if its centre lies on the inward side
};

Offset off_centreline(const Tube& tube, const Vector2d& p) {
  const auto from_line = [](const Vector2d& start, const Vector2d& t, const Vector2d& q) {
    const double off = across(t).dot(q - start);
    return Offset{std::fabs(off), (off < 0 ? -1.0 : 1.0) * across(t), t, 0};
  };
  if (p.x() <= tube.lead_m && p.y() < tube.bend_radius_m) return from_line({0, 0}, {1, 0}, p);
  const Vector2d centre(tube.lead_m, tube.bend_radius_m), r = p - centre;
  const double angle = std::atan2(r.x(), -r.y()), distance = r.norm();
  if (angle >= tube.angle_rad || angle < 0) {
    const Vector2d t = along(tube.angle_rad);
    return from_line(centre - tube.bend_radius_m * across(t), t, p);
  }
  const Vector2d radial = r / distance;
  const bool outside = distance > tube.bend_radius_m;
  return {std::fabs(distance - tube.bend_radius_m), outside ? radial : Vector2d(-radial), across(radial),
          (outside ? 1 : -1) / distance};
}

/// Segments and nodes are counted from the tip: segment j connects node j + 1 to node j, node n is the base.
class BlockTridiagonal {
 public:
  BlockTridiagonal(const Tube& tube, const Wire& wire, const Setting& setting)
      : tube_(tube), wire_(wire), setting_(setting), h_(setting.segment_m) {}

  int size() const { return static_cast<int>(angle_.size()); }

  /// Adds or removes one segment: every node takes the position of its neighbour.
  bool advance(bool forward) {
    const std::vector<Vector2d> before = nodes(angle_);
    const int n = size() + (forward ? 1 : -1);
    VectorXd next(n);
    for (int j = 0; j < n; ++j) {
      const int from = forward ? j - 1 : j + 1;
      next[j] = from >= 0 && from < size() ? angle_[from] : forward && size() > 0 ? angle_[0] : 0;
    }
    // Previous positions of material that is still inside; material that has just entered was on the axis at the base.
    old_.assign(n, setting_.base_m);
    for (int i = 0; i < n && i <= size(); ++i) old_[i] = before[i];
    if (forward && n > 0) old_[n - 1] = setting_.base_m;
    std::vector<double> force(n, 0.0);  // of friction: nodes keep their previous values
    for (int i = 0; i < n && i < static_cast<int>(normal_.size()); ++i) force[i] = normal_[i];
    normal_ = force;
    angle_ = next;
    return settle();
  }

  Rest rest() const {
    Rest out;
    out.inserted_m = size() * h_;
    const std::vector<Vector2d> p = nodes(angle_);
    out.curve.assign(p.rbegin(), p.rend());
    for (int i = 0; i < size(); ++i) out.push_N += slope(i, p[i]).x();
    return out;
  }

 private:
  const Piece& piece(double from_tip) const {
    for (const Piece& p : wire_.pieces)
      if (from_tip < p.to_tip_m) return p;
    return wire_.pieces.back();
  }

  std::vector<Vector2d> nodes(const VectorXd& angle) const {
    const int n = static_cast<int>(angle.size());
    std::vector<Vector2d> p(n + 1, setting_.base_m);
    for (int j = n - 1; j >= 0; --j) p[j] = p[j + 1] + h_ * along(angle[j]);
    return p;
  }

  double weight(int i) const { return piece(i * h_).kg_per_m * (i == 0 ? 0.5 : 1) * h_ * setting_.gravity_m_s2; }
  double depth(const Offset& o) const { return o.distance - (tube_.radius_m - wire_.radius_m); }
  double share(int i) const { return (i == 0 ? 0.5 : 1) * h_; }

  double potential(int i, const Vector2d& p) const {
    const Offset o = off_centreline(tube_, p);
    const double d = std::max(depth(o), 0.0), u = slid(i, p);
    return weight(i) * p.y() + setting_.wall_N_m2 * share(i) * d * d / 2 +
           setting_.friction * normal_[i] * (std::hypot(u, smooth_m) - smooth_m);
  }

  /// Direction along the wall at the node's position at the beginning of the increment.
  Vector2d way(int i) const { return off_centreline(tube_, old_[i]).tangent; }
  double slid(int i, const Vector2d& p) const { return way(i).dot(p - old_[i]); }

  Vector2d slope(int i, const Vector2d& p, Matrix2d* curve = nullptr) const {
    const Offset o = off_centreline(tube_, p);
    const double d = std::max(depth(o), 0.0), u = slid(i, p), root = std::hypot(u, smooth_m),
                 drag = setting_.friction * normal_[i], k = setting_.wall_N_m2 * share(i);
    const Vector2d t = way(i);
    if (curve) {
      *curve = drag * smooth_m * smooth_m / (root * root * root) * t * t.transpose();
      if (d > 0)
        *curve += k * o.outwards * o.outwards.transpose() + k * d * o.bend_per_m * o.tangent * o.tangent.transpose();
    }
    return Vector2d(0, weight(i)) + k * d * o.outwards + drag * u / root * t;
  }

  /// Joint proximal to segment j, half a segment on either side where there is one: its stiffness, and its angle beyond
  /// rest.
  double behind(int j) const { return j + 1 == size() ? 0 : h_ / 2; }
  double stiffness(int j) const {
    const double at = (j + 1) * h_;
    return 1 / (h_ / 2 / piece(at - h_ / 4).EI_N_m2 + behind(j) / piece(at + h_ / 4).EI_N_m2);
  }
  double bent(const VectorXd& angle, int j) const {
    const double at = (j + 1) * h_;
    return angle[j] - (j + 1 == size() ? 0 : angle[j + 1]) - h_ / 2 * piece(at - h_ / 4).curvature_per_m -
           behind(j) * piece(at + h_ / 4).curvature_per_m;
  }

  double energy(const VectorXd& angle) const {
    const std::vector<Vector2d> p = nodes(angle);
    double sum = 0;
    for (int j = 0; j < size(); ++j) {
      const double b = bent(angle, j);
      sum += stiffness(j) * b * b / 2 + potential(j, p[j]);
    }
    return sum;
  }

  void linearise(VectorXd& gradient, MatrixXd& hessian) const {
    const int n = size();
    const std::vector<Vector2d> p = nodes(angle_);
    gradient.setZero(n), hessian.setZero(n, n);
    std::vector<Vector2d> lever(n);
    std::vector<Matrix2d> curves(n);  // accumulated over the nodes so far
    Vector2d slopes = Vector2d::Zero();
    Matrix2d sum = Matrix2d::Zero(), one;
    for (int j = 0; j < n; ++j) {
      slopes += slope(j, p[j], &one);
      curves[j] = sum += one;
      const Vector2d t = along(angle_[j]);
      lever[j] = h_ * across(t);
      gradient[j] += lever[j].dot(slopes);
      hessian(j, j) -= h_ * t.dot(slopes);
    }
    for (int j = 0; j < n; ++j)
      for (int k = 0; k <= j; ++k) {
        const double both = lever[j].dot(curves[k] * lever[k]);
        hessian(j, k) += both;
        if (j != k) hessian(k, j) += both;
      }
    for (int j = 0; j < n; ++j) {
      const double S = stiffness(j), m = S * bent(angle_, j);
      gradient[j] += m, hessian(j, j) += S;
      if (j + 1 == n) continue;
      gradient[j + 1] -= m, hessian(j + 1, j + 1) += S;
      hessian(j, j + 1) -= S, hessian(j + 1, j) -= S;
    }
  }

  /// Descends with the normal forces of friction held constant.
  bool minimise() {
    return test::descend(
        how, [this](const VectorXd& a) { return energy(a); },
        [this](VectorXd& gradient, MatrixXd& hessian) { linearise(gradient, hessian); }, angle_);
  }

  bool settle() {
    for (int round = 0; round < most_rounds; ++round) {
      if (!minimise()) return false;
      if (setting_.friction == 0) return true;
      const std::vector<Vector2d> p = nodes(angle_);
      double change = 0, largest = 1e-6;
      for (int i = 0; i < size(); ++i) {
        const double force = setting_.wall_N_m2 * share(i) * std::max(depth(off_centreline(tube_, p[i])), 0.0);
        change = std::max(change, std::fabs(force - normal_[i])), largest = std::max(largest, force);
        normal_[i] = 0.5 * (normal_[i] + force);
      }
      if (change < force_tolerance * largest) return true;
    }
    return true;  // as close as it gets
  }

  const Tube& tube_;
  const Wire& wire_;
  const Setting& setting_;
  double h_;
  VectorXd angle_;              ///< of segments
  std::vector<Vector2d> old_;   ///< previous positions of nodes
  std::vector<double> normal_;  ///< of nodes, N
};

}  // namespace

std::vector<Rest> push(const Tube& tube, const Wire& wire, const Setting& setting,
                       const std::vector<double>& inserted) {
  BlockTridiagonal chain(tube, wire, setting);
  std::vector<Rest> out;
  bool good = true;
  for (double to : inserted) {
    const int n = static_cast<int>(std::lround(to / setting.segment_m));
    while (good && chain.size() != n) good = chain.advance(chain.size() < n);
    out.push_back(chain.rest());
    out.back().converged = good;
  }
  return out;
}

}  // namespace ostium::pushed_chain
