#include <algorithm>
#include <cmath>
#include <optional>

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

/// From one slip that is seen, or from where the hand turned round, to the next.
struct Stretch {
  double since_m = 0, whole_m = 0;  ///< what the hand has moved in it, and moves in all
  bool slips_after = false;         ///< at its end
};

/// Of each sample.
std::vector<Stretch> stretches(const Passage& run) {
  const Eigen::Index n = run.inserted_m.size();
  std::vector<Stretch> out(static_cast<std::size_t>(n));
  Eigen::Index from = 0;
  const auto close = [&](Eigen::Index end, bool slips) {
    const double last = run.inserted_m[std::min(end, n - 1)];
    for (Eigen::Index k = from; k < end; ++k) {
      const double begun = run.inserted_m[from];
      out[static_cast<std::size_t>(k)] = {std::fabs(run.inserted_m[k] - begun), std::fabs(last - begun), slips};
    }
    from = end;
  };
  for (Eigen::Index k = 1; k < n; ++k) {
    const bool slips = run.slips[static_cast<std::size_t>(k)];
    if (slips || run.direction[k] != run.direction[k - 1]) close(k, slips);
  }
  close(n, false);
  return out;
}

/// Friction at rest, less that in motion, builds up while the wire stands, and falls to nothing when it slips. The hand
/// moves on meanwhile. `standing`: how much has built up, N.
class Sticking {
 public:
  Sticking(const Setup& setup, const Passage& run) : setup_(setup), run_(run), stretches_(stretches(run)) {}

  /// What the hand feels more at sample `k`, of friction that is `moving_N` in motion, after it moved by `by_m`.
  double more(Eigen::Index k, double moving_N, double by_m) {
    constexpr double most_hidden = 3;  // teeth in a stretch of which it is still known where they are
    const double most = setup_.sticking * std::fabs(moving_N), rate = setup_.hand_N_per_m;
    const Stretch& s = stretches_[static_cast<std::size_t>(k)];
    if (most <= 0) return 0;
    // When it slipped within a step follows from what had built up before.
    const double built = rate * std::fabs(by_m);
    if (run_.slips[static_cast<std::size_t>(k)]) left_ = std::clamp(standing_ + built - most, 0.0, built);
    if (k > 0 && run_.direction[k] != run_.direction[k - 1]) left_ = 0;
    // Slips in between are too small to be seen: as many as fit, or half of what they hold.
    const double all = left_ + rate * s.whole_m, hidden = std::max(std::round(all / most), 1.0);
    const double now = left_ + rate * s.since_m;
    if (s.slips_after && hidden <= most_hidden)
      standing_ = std::min(std::fmod(now, all / hidden), most);
    else
      standing_ = now <= most && all <= most_hidden * most ? now : most / 2;
    return run_.direction[k] * standing_;
  }

 private:
  const Setup& setup_;
  const Passage& run_;
  std::vector<Stretch> stretches_;
  double standing_ = 0, left_ = 0;
};

VectorXd forces_of(const Setup& setup, const Passage& run) {
  const VectorXd& x = run.inserted_m;
  VectorXd out(x.size());
  const Path path(setup, run);
  std::optional<Sticking> sticking;
  if (!run.slips.empty() && setup.sticking > 0) sticking.emplace(setup, run);
  double distance = run.run_before_m;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const double by = k > 0 ? x[k] - x[k - 1] : 0;
    distance += std::fabs(by);
    const double friction = setup.friction * (1 + setup.worn_per_m * distance);
    const double moving = path.at_hand(x[k], run.tip_N[k], friction * run.direction[k]);
    out[k] = moving + setup.zero_N;
    if (run.time_s.size() > 0) out[k] += setup.drift_N_per_s * run.time_s[k];
    if (sticking) out[k] += sticking->more(k, moving - run.tip_N[k], by);
  }
  return out;
}

}  // namespace

double hand_force(const Setup& setup, const Passage& run, double inserted_m, double tip_N, double direction,
                  double friction) {
  return Path(setup, run).at_hand(inserted_m, tip_N, friction * direction);
}

std::vector<bool> falls_of(const VectorXd& force, const VectorXd& direction, double sigma) {
  constexpr double far_off = 3, rare = 0.025;
  constexpr Eigen::Index few = 8;
  const Eigen::Index n = force.size();
  const double least = far_off * std::sqrt(2.0) * sigma;
  const auto rise = [&](Eigen::Index k) {  // to sample k, if the hand went on as before
    return k > 0 && k < n && direction[k] == direction[k - 1] ? direction[k] * (force[k] - force[k - 1]) : 0;
  };
  std::vector<bool> out(static_cast<std::size_t>(n), false);
  Eigen::Index count = 0;
  for (Eigen::Index k = 1; k < n; ++k) {
    if (rise(k) > -least || rise(k - 1) > least || rise(k + 1) > least) continue;
    out[static_cast<std::size_t>(k)] = true, ++count;
  }
  if (count < few || static_cast<double>(count) < rare * static_cast<double>(n)) out.clear();
  return out;
}

std::vector<curves::Curves> hand_forces(const Setup& setup) {
  std::vector<curves::Curves> out;
  for (const Passage& run : setup.runs) out.push_back({forces_of(setup, run)});
  return out;
}

}  // namespace ostium::data::push_pull
