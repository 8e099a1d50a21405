#include <algorithm>
#include <cmath>

#include "data/identification/curves/push_pull/contact.h"
#include "data/identification/curves/push_pull/push_pull.h"

namespace ostium::data::push_pull {

namespace {

using Eigen::VectorXd;

constexpr double least_clearance_m = 1e-6, nearby_m = 1e-6;

double stiffness(const Setup& setup, double from_tip_m) {
  double EI = setup.sections.back().EI_N_m2;
  for (const Section& s : setup.sections)
    if (from_tip_m < s.to_m) {
      EI = s.EI_N_m2;
      break;
    }
  return from_tip_m < setup.soft_m ? EI * setup.soft_share : EI;
}

/// Distances from the tip at which the stiffness changes, rising.
std::vector<double> changes(const Setup& setup) {
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < setup.sections.size(); ++i) out.push_back(setup.sections[i].to_m);
  if (setup.soft_m > 0) out.push_back(setup.soft_m);
  std::sort(out.begin(), out.end());
  return out;
}

/// Axial force after a bend by an angle (capstan).
double around(double T, double mu, double angle) { return T * std::exp(mu * (T > 0 ? 1 : -1) * angle); }

/// Friction at rest, less that in motion, builds up while the wire stands, and falls to nothing when it slips. The hand
/// moves on meanwhile. `standing`: how much has built up, N.
class Sticking {
 public:
  explicit Sticking(const Setup& setup) : setup_(setup) {}

  /// What the hand feels more, of friction that is `moving_N` in motion, after it moved by `by_m` in `seconds`.
  double more(double moving_N, double by_m, double seconds) {
    const double most = setup_.sticking * std::fabs(moving_N);
    const bool fast = seconds > 0 && std::fabs(by_m) > setup_.sticks_below_m_s * seconds;
    if (most <= 0 || fast || by_m == 0) return standing_ = 0;
    if (by_m * direction_ < 0) standing_ = 0;
    direction_ = by_m > 0 ? 1 : -1;
    standing_ = std::fmod(standing_ + setup_.hand_N_per_m * std::fabs(by_m), most);
    return direction_ * standing_;
  }

 private:
  const Setup& setup_;
  double standing_ = 0, direction_ = 0;
};

VectorXd forces_of(const Setup& setup, const Passage& run) {
  const VectorXd& x = run.inserted_m;
  VectorXd out(x.size());
  Sticking sticking(setup);
  double distance = run.run_before_m;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const double by = k > 0 ? x[k] - x[k - 1] : 0;
    distance += std::fabs(by);
    const double friction = setup.friction * (1 + setup.worn_per_m * distance);
    const double moving = hand_force(setup, run, x[k], run.tip_N[k], run.direction[k], friction);
    out[k] = moving + setup.zero_N;
    if (run.time_s.size() == 0) continue;
    out[k] += setup.drift_N_per_s * run.time_s[k];
    out[k] += sticking.more(moving - run.tip_N[k], by, k > 0 ? run.time_s[k] - run.time_s[k - 1] : 0);
  }
  return out;
}

}  // namespace

double hand_force(const Setup& setup, const Passage& run, double inserted_m, double tip_N, double direction,
                  double friction) {
  const double mu = friction * direction;
  const double c = std::max(run.bore_radius_m + setup.bore_more_m - setup.radius_m, least_clearance_m);
  const std::vector<double> places = changes(setup);
  double T = tip_N;
  for (std::size_t b = run.bends.size(); b-- > 0;) {
    const Bend& bend = run.bends[b];
    const double depth = inserted_m - bend.at_m, length = bend.end_m() - bend.at_m;
    if (depth <= 0) continue;
    const double root = std::sqrt(bend.radius_m * c), unit = 1 / (bend.radius_m * root),
                 in_bend = std::min(depth, length);
    const ContactForces N = contact_forces(depth / root, length / root);
    T += mu * N.at_end * unit * stiffness(setup, std::max(depth - length, 0.0));
    double at = in_bend;
    for (const double place : places) {
      const double there = depth - place;
      if (there <= 0 || there >= at) continue;
      const double before = stiffness(setup, place - nearby_m), behind = stiffness(setup, place + nearby_m);
      const double larger = std::max(before, behind), smaller = std::min(before, behind);
      T = around(T, mu, (at - there) / bend.radius_m) + mu * contact::at_change(smaller / larger) * unit * larger;
      at = there;
    }
    T = around(T, mu, at / bend.radius_m);
    T += mu * N.at_beginning * unit * stiffness(setup, depth);
  }
  return T;
}

std::vector<curves::Curves> hand_forces(const Setup& setup) {
  std::vector<curves::Curves> out;
  for (const Passage& run : setup.runs) out.push_back({forces_of(setup, run)});
  return out;
}

}  // namespace ostium::data::push_pull
