#include "data/identification/effects/beams_with_play.h"

#include <Eigen/SparseCholesky>
#include <cmath>

namespace ostium::data {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

constexpr double hard = 30;         // stiffness of the bore relative to one cell of the beams
constexpr double tolerance = 1e-7;  // relative to the play
constexpr int most_iterations = 100, halvings = 20;

class Obstacle {
 public:
  explicit Obstacle(const BeamsWithPlay& b) : b_(b), n_(static_cast<int>(b.EI_r_N_m2.size())) {
    double stiffest = 0;
    for (double EI : b.EI_r_N_m2) stiffest = std::max(stiffest, EI);
    bore_N_m_ = hard * stiffest / std::pow(b.cell_m, 3);
    assemble();
  }

  Offsets run() {
    VectorXd d = VectorXd::Zero(2 * n_), gradient;
    for (int k = 0; k < most_iterations; ++k) {
      const Sparse H = linearise(d, gradient);
      if (k == 0) factors_.analyzePattern(H);
      factors_.factorize(H);
      const VectorXd step = -factors_.solve(gradient);
      if (step.cwiseAbs().maxCoeff() < tolerance * b_.play_m) break;
      d += least_along(d, step) * step;
    }
    const auto node = [&](int i) -> Vector2d { return i > 0 ? Vector2d(d.segment<2>(2 * i - 2)) : Vector2d::Zero(); };
    const double h = b_.cell_m;
    Offsets out;
    for (int i = 0; i < n_; ++i)
      out.bend_per_m.push_back((node(i > 0 ? i - 1 : 1) - 2 * node(i) + node(i + 1)) / (h * h));
    out.bend_per_m.push_back(b_.differ_per_m.back() + b_.tip_couple_Nm / b_.EI_r_N_m2.back());
    out.tip_m = node(n_), out.tip_slope = (node(n_) - node(n_ - 1)) / h + h / 2 * out.bend_per_m.back();
    return out;
  }

 private:
  double weight(int i) const { return (i == 0 ? 0.5 : 1) * b_.cell_m * b_.EI_r_N_m2[i]; }

  /// The energy without the bore: d K d / 2 - pull d.
  void assemble() {
    std::vector<Eigen::Triplet<double>> entries;
    pull_ = VectorXd::Zero(2 * n_);
    const double h2 = b_.cell_m * b_.cell_m;
    for (int i = 0; i < n_; ++i) {
      // d'' at node i; free nodes are 1 to n. At the base, node 0, a mirrored node is used.
      const int nodes[] = {i - 1, i, i + 1};
      const double by[] = {i == 0 ? 0 : 1 / h2, -2 / h2, i == 0 ? 2 / h2 : 1 / h2};
      for (int a = 0; a < 3; ++a) {
        if (nodes[a] < 1) continue;
        pull_.segment<2>(2 * nodes[a] - 2) += weight(i) * by[a] * b_.differ_per_m[i];
        for (int c = 0; c < 3; ++c)
          for (int k = 0; k < 2 && nodes[c] >= 1; ++k)
            entries.emplace_back(2 * nodes[a] - 2 + k, 2 * nodes[c] - 2 + k, weight(i) * by[a] * by[c]);
      }
    }
    pull_.segment<2>(2 * n_ - 2) += b_.tip_force_N + b_.tip_couple_Nm / b_.cell_m;
    pull_.segment<2>(2 * n_ - 4) -= b_.tip_couple_Nm / b_.cell_m;
    for (int i = 0; i < n_; ++i)
      for (int k = 0; k < 4; ++k) entries.emplace_back(2 * i + k / 2, 2 * i + k % 2, 0);  // entries for the bore
    K_.resize(2 * n_, 2 * n_);
    K_.setFromTriplets(entries.begin(), entries.end());
  }

  VectorXd slope(const VectorXd& d) const {
    VectorXd out = K_ * d - pull_;
    for (int i = 0; i < n_; ++i) {
      const Vector2d at = d.segment<2>(2 * i);
      const double off = at.norm(), beyond = off - b_.play_m;
      if (beyond > 0) out.segment<2>(2 * i) += bore_N_m_ * beyond / off * at;
    }
    return out;
  }

  /// Exact line search: the share of the step at which the energy, which is convex, is least.
  double least_along(const VectorXd& d, const VectorXd& step) const {
    double low = 0, high = 1;
    if (slope(d + step).dot(step) <= 0) return 1;
    for (int k = 0; k < halvings; ++k) {
      const double middle = (low + high) / 2;
      (slope(d + middle * step).dot(step) > 0 ? high : low) = middle;
    }
    return (low + high) / 2;
  }

  Sparse linearise(const VectorXd& d, VectorXd& gradient) const {
    Sparse H = K_;
    gradient = slope(d);
    for (int i = 0; i < n_; ++i) {
      const Vector2d at = d.segment<2>(2 * i);
      const double off = at.norm(), beyond = off - b_.play_m;
      if (beyond <= 0) continue;
      const Vector2d e = at / off;
      const Matrix2d outwards = e * e.transpose();
      const Matrix2d more = bore_N_m_ * (outwards + beyond / off * (Matrix2d::Identity() - outwards));
      for (int k = 0; k < 4; ++k) H.coeffRef(2 * i + k / 2, 2 * i + k % 2) += more(k / 2, k % 2);
    }
    return H;
  }

  const BeamsWithPlay& b_;
  int n_;
  double bore_N_m_ = 0;
  Sparse K_;
  VectorXd pull_;
  Eigen::SimplicialLDLT<Sparse> factors_;
};

}  // namespace

Offsets offsets_of(const BeamsWithPlay& beams) { return Obstacle(beams).run(); }

}  // namespace ostium::data
