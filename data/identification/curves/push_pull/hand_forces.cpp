#include <algorithm>
#include <cmath>
#include <limits>

#include "data/identification/curves/push_pull/push_pull.h"

namespace ostium::data::push_pull {

namespace {

using Eigen::VectorXd;

constexpr double least_clearance_m = 1e-6;

/// Of insertions between which forces are interpolated: close enough for the onset of a touch.
double stations_apart_m(const Setup& setup, std::size_t path) { return setup.walls->spacing_m(path) / 2; }

/// From the tip on, the soft part cut off from the sections that it covers.
std::vector<StiffPiece> pieces(const Setup& setup) {
  std::vector<StiffPiece> out;
  for (const curves::InstrumentSection& s : setup.sections) {
    if (s.from_tip_m < setup.soft_m) out.push_back({std::min(s.to_m, setup.soft_m), s.EI_N_m2 * setup.soft_share});
    if (s.to_m > setup.soft_m) out.push_back({s.to_m, s.EI_N_m2});
  }
  return out;
}

/// A wire in one path.
class Path {
 public:
  Path(const Setup& setup, const Passage& run) : between_samples_(run.between_samples) {
    const std::vector<StiffPiece> stiffness = pieces(setup);
    const double declared = std::max(run.bore_radius_m - setup.radius_m, least_clearance_m);
    const std::size_t number = setup.walls->path(run.bends, declared);
    walls_ = &setup.walls->shape(number, std::max(declared + setup.bore_more_m, least_clearance_m), stiffness);
    apart_ = stations_apart_m(setup, number), EI_ = stiffness.back().EI_N_m2;
  }

  /// Force at the hand: friction of what its stiffness presses with, and of its axial force in bends (capstan).
  double at_hand(double inserted_m, double tip_N, double mu) const {
    if (!between_samples_) return exactly(inserted_m, tip_N, mu);
    const double place = inserted_m / apart_, below = std::floor(place);
    const double low = exactly(below * apart_, tip_N, mu), high = exactly((below + 1) * apart_, tip_N, mu);
    return low + (place - below) * (high - low);
  }

 private:
  double exactly(double inserted_m, double tip_N, double mu) const {
    const Pressing& p = walls_->at(inserted_m);
    double T = tip_N, at = p.turned_rad;
    for (std::size_t k = p.places.size(); k-- > 0;) {
      T = around(T, mu, at - p.places[k].turned_rad) + mu * EI_ * p.places[k].per_stiffness;
      at = p.places[k].turned_rad;
    }
    return around(T, mu, at);
  }
  static double around(double T, double mu, double angle) {
    if (T == 0 || angle == 0) return T;
    return T * std::exp((T > 0 ? mu : -mu) * angle);
  }

  bool between_samples_;
  double apart_, EI_;
  KnownWalls::Shape* walls_;
};

/// What is known of a run beside its teeth.
SlidingRun sliding(const Setup& setup, const Passage& run) {
  const VectorXd& x = run.inserted_m;
  const Path path(setup, run);
  SlidingRun out{run.measured_N, VectorXd(x.size()), VectorXd(x.size()), run.direction, x, run.sigma_N};
  double distance = run.run_before_m;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    distance += k > 0 ? std::fabs(x[k] - x[k - 1]) : 0;
    const double friction = setup.friction * (1 + setup.worn_per_m * distance);
    const double moving = path.at_hand(x[k], run.tip_N[k], friction * run.direction[k]);
    out.friction_N[k] = std::fabs(moving - run.tip_N[k]);
    out.moving_N[k] = moving + setup.zero_N;
    if (run.time_s.size() > 0) out.moving_N[k] += setup.drift_N_per_s * run.time_s[k];
  }
  return out;
}

/// In the middle of a run's samples, m/s; 0 if its times are unknown.
double speed_of(const Passage& run) {
  std::vector<double> speeds;
  for (Eigen::Index k = 1; k < run.time_s.size(); ++k) {
    const double by = std::fabs(run.inserted_m[k] - run.inserted_m[k - 1]), in = run.time_s[k] - run.time_s[k - 1];
    if (by > 0 && in > 0) speeds.push_back(by / in);
  }
  if (speeds.empty()) return 0;
  const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
  std::nth_element(speeds.begin(), middle, speeds.end());
  return *middle;
}

/// Up to which speed wires stick, from what likelihoods say: `less`, by how much teeth make a run less surprising. The
/// slowest run always has teeth; speeds that differ little are one.
double sticks_up_to(const std::vector<double>& speeds, const std::vector<double>& less) {
  constexpr double alike = 1.2;
  double best = -std::numeric_limits<double>::infinity(), out = 0;
  for (const double slow : speeds) {
    double sum = 0;
    for (std::size_t r = 0; r < speeds.size(); ++r)
      if (speeds[r] <= alike * slow) sum += less[r];
    if (sum > best) best = sum, out = alike * slow;
  }
  return out;
}

}  // namespace

double hand_force(const Setup& setup, const Passage& run, double inserted_m, double tip_N, double direction,
                  double friction) {
  return Path(setup, run).at_hand(inserted_m, tip_N, friction * direction);
}

Sticking likely_sticking(const Setup& setup) {
  const auto slowest = std::min_element(setup.runs.begin(), setup.runs.end(),
                                        [](const Passage& a, const Passage& b) { return speed_of(a) < speed_of(b); });
  return likely_sticking(sliding(setup, *slowest));
}

curves::Foretold hand_forces(const Setup& setup) {
  std::vector<SlidingRun> runs;
  for (const Passage& run : setup.runs) runs.push_back(sliding(setup, run));
  std::vector<curves::Curves> forces;
  for (const SlidingRun& run : runs) forces.push_back({run.moving_N});
  curves::Foretold out(std::move(forces));
  if (!(setup.sticking > 0)) return out;
  std::vector<SawTeeth> teeth;
  std::vector<double> speeds, less;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    teeth.push_back(saw_teeth(runs[r], {setup.sticking, setup.hand_N_per_m}));
    const VectorXd none = VectorXd::Zero(runs[r].moving_N.size());
    less.push_back(surprise(runs[r], {none, none}) - surprise(runs[r], teeth[r]));
    speeds.push_back(speed_of(setup.runs[r]));
    out.open.push_back({none});
  }
  const double slow = sticks_up_to(speeds, less);
  for (std::size_t r = 0; r < runs.size(); ++r)
    if (speeds[r] <= slow) out.curves[r][0] += teeth[r].mean_N, out.open[r][0] = teeth[r].spread_N;
  return out;
}

}  // namespace ostium::data::push_pull
