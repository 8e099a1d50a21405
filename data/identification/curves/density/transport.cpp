#include <algorithm>
#include <cmath>

#include "data/identification/curves/density/density.h"

namespace ostium::data::density {

namespace {

using Eigen::VectorXd;

constexpr double grid_m = 0.5e-3;      // along the artery
constexpr double grid_s = 6e-3;        // at the inlet
constexpr double edge_m = 2e-3;        // over which a narrowing begins and ends
constexpr double of_spread = 1.0 / 6;  // volume of a cell, of the least spread
constexpr double reach = 4.5;          // spreads that a smear is followed to

/// Of samples in rising order, linear between them.
template <class List>
double between(const List& x, const List& y, double at) {
  if (at <= x[0]) return y[0];
  const auto last = x.size() - 1;
  if (at >= x[last]) return y[last];
  const auto i = static_cast<decltype(last)>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
  return y[i - 1] + (at - x[i - 1]) / (x[i] - x[i - 1]) * (y[i] - y[i - 1]);
}

/// Where a place lies that is seen so far along the picture of the artery.
double true_place(const Stretch& seen, double at_m) {
  const double within = std::clamp(at_m - seen.from_m, 0.0, seen.factor * (seen.to_m - seen.from_m));
  return at_m + within * (1 / seen.factor - 1);
}

}  // namespace

double area_m2(const Setup& setup, double at_m) {
  const Stretch& n = setup.narrow;
  const double inside = std::min(at_m - n.from_m, n.to_m - at_m) / edge_m + 0.5;
  const double d = between(setup.place_m, setup.diameter_m, at_m) * (1 + (n.factor - 1) * std::clamp(inside, 0.0, 1.0));
  return M_PI / 4 * d * d;
}

namespace {

/// What lies before a site.
struct Way {
  double volume_m3 = 0, variance_m6 = 0;  ///< as passed at the inlet
  double m4_per_kg = 0;                   ///< density over the concentration at the inlet: k A, diluted
};

std::vector<Way> ways(const Setup& setup) {
  std::vector<double> to;
  for (const double site : setup.site_m) to.push_back(true_place(setup.foreshortened, site));
  const double end = *std::max_element(to.begin(), to.end()) + grid_m;
  const auto cells = static_cast<Eigen::Index>(std::ceil(end / grid_m));
  VectorXd place(cells + 1), volume(cells + 1), variance(cells + 1);
  place[0] = volume[0] = variance[0] = 0;
  const auto behind = [](const Junction& junction, double at_m) {
    return std::clamp((at_m + grid_m - junction.at_m) / grid_m, 0.0, 1.0);
  };
  for (Eigen::Index i = 0; i < cells; ++i) {
    const double from = static_cast<double>(i) * grid_m;
    const double cell = grid_m * area_m2(setup, from + grid_m / 2);
    const double share =
        (1 - setup.branch.share * behind(setup.branch, from)) * (1 + setup.inflow.share * behind(setup.inflow, from));
    place[i + 1] = from + grid_m;
    volume[i + 1] = volume[i] + cell / share;
    variance[i + 1] = variance[i] + 2 * setup.dispersion_m3 * cell / (share * share);
  }
  std::vector<Way> out;
  for (Eigen::Index s = 0; s < setup.site_m.size(); ++s) {
    const double at = to[static_cast<std::size_t>(s)], seen = setup.site_m[s];
    const Stretch& f = setup.foreshortened;
    const bool shorter = seen >= f.from_m && seen <= f.from_m + f.factor * (f.to_m - f.from_m);
    const double diluted = at > setup.inflow.at_m ? 1 / (1 + setup.inflow.share) : 1;
    out.push_back({between(place, volume, at), between(place, variance, at),
                   setup.m2_per_kg * area_m2(setup, at) * diluted / (shorter ? f.factor : 1)});
  }
  return out;
}

/// What has passed the ostium by a time: volume, and iodine.
class Inlet {
 public:
  Inlet(const Setup& setup, const Beat& beat, const Film& film) : setup_(setup), beat_(beat), film_(film) {
    start_s_ = film.injection.start_s + setup.injection_later_s;
    const double first = std::min(true_time(film.time_s[0]), start_s_), last = true_time(film.time_s.tail<1>()[0]);
    for (double t = first; t < last + grid_s; t += grid_s) time_s_.push_back(t);
    add_bends(first, last);
    std::sort(time_s_.begin(), time_s_.end());
    volume_m3_ = iodine_kg_ = {0};
    for (std::size_t k = 0; k + 1 < time_s_.size(); ++k) {
      constexpr double beside = 1e-9;
      const double dt = time_s_[k + 1] - time_s_[k], from = time_s_[k] + beside, to = time_s_[k + 1] - beside;
      const double q[] = {flow(from), flow(to)};
      volume_m3_.push_back(volume_m3_[k] + std::max(dt * (q[0] + q[1]) / 2, 0.0));
      const double entering = (std::min(q[0], rate(from)) + std::min(q[1], rate(to))) / 2;
      iodine_kg_.push_back(iodine_kg_[k] + dt * setup.iodine * film.injection.iodine_kg_m3 * entering);
    }
  }
  double true_time(double frame_s) const { return setup_.time_scale * frame_s + setup_.film_later_s; }
  double volume_m3(double time_s) const { return between(time_s_, volume_m3_, time_s); }
  /// Mean concentration in cells of volume.
  VectorXd cells(double cell_m3) const {
    VectorXd out(static_cast<Eigen::Index>(std::ceil(volume_m3_.back() / cell_m3)) + 1);
    double before = 0;
    std::size_t k = 0;
    for (Eigen::Index i = 0; i < out.size(); ++i) {
      const double to = static_cast<double>(i + 1) * cell_m3;
      while (k + 2 < volume_m3_.size() && volume_m3_[k + 1] < to) ++k;
      const double width = volume_m3_[k + 1] - volume_m3_[k];
      const double part = width > 0 ? std::min((to - volume_m3_[k]) / width, 1.0) : 1;
      const double passed = iodine_kg_[k] + part * (iodine_kg_[k + 1] - iodine_kg_[k]);
      out[i] = (passed - before) / cell_m3, before = passed;
    }
    return out;
  }
  double all_m3() const { return volume_m3_.back(); }

 private:
  double rate(double time_s) const {
    const Injection& i = film_.injection;
    const double since = time_s - start_s_, edge = std::min(since, i.length_s - since);
    const double share = i.ramp_s > 0 ? std::clamp(edge / i.ramp_s, 0.0, 1.0) : edge > 0;
    return i.rate_m3_s * share * (1 - setup_.runs_back);
  }
  double flow(double time_s) {
    const std::vector<double>&phase = beat_.phase, &q = beat_.relative;
    double at = (time_s + film_.phase_s) / beat_.length_s;
    at -= std::floor(at);
    // Times rise, and with them phases, until the next beat.
    std::size_t& k = near_;
    if (at < phase[k - 1]) k = 1;
    while (k + 1 < phase.size() && phase[k] <= at) ++k;
    const double width = phase[k] - phase[k - 1];
    const double shape = width > 0 ? q[k - 1] + (at - phase[k - 1]) / width * (q[k] - q[k - 1]) : q[k];
    const double since = time_s - start_s_;
    if (setup_.rise == 0 || since < 0) return film_.flow_m3_s * shape;
    return film_.flow_m3_s * shape * (1 - setup_.rise * std::expm1(-since / setup_.rise_s));
  }
  /// Where flow or injection bends or steps.
  void add_bends(double first, double last) {
    const Injection& i = film_.injection;
    for (const double at : {0.0, i.ramp_s, i.length_s - i.ramp_s, i.length_s})
      if (start_s_ + at > first && start_s_ + at < last) time_s_.push_back(start_s_ + at);
    const std::vector<double>& phase = beat_.phase;
    for (std::size_t k = 1; k < phase.size(); ++k) {
      if (phase[k] != phase[k - 1]) continue;
      double at = phase[k] * beat_.length_s - film_.phase_s;
      at += std::ceil((first - at) / beat_.length_s) * beat_.length_s;
      for (; at < last; at += beat_.length_s) time_s_.push_back(at);
    }
  }

  const Setup& setup_;
  const Beat& beat_;
  const Film& film_;
  double start_s_ = 0;
  std::size_t near_ = 1;  // in the beat
  std::vector<double> time_s_, volume_m3_, iodine_kg_;
};

double below(double x) { return std::erfc(-x * M_SQRT1_2) / 2; }

/// Cells, smeared by a normal law, at any volume.
class Smeared {
 public:
  Smeared(const VectorXd& cells, double cell_m3, double spread_m3) : cells_(cells), cell_m3_(cell_m3) {
    half_ = static_cast<Eigen::Index>(std::ceil(reach * spread_m3 / cell_m3));
    weights_.resize(2 * half_ + 1);
    const double width = cell_m3 / std::max(spread_m3, 1e-6 * cell_m3);
    double before = below((-static_cast<double>(half_) - 0.5) * width);
    for (Eigen::Index j = -half_; j <= half_; ++j) {
      const double next = below((static_cast<double>(j) + 0.5) * width);
      weights_[j + half_] = next - before, before = next;
    }
  }
  double at(double volume_m3) const {
    const double place = volume_m3 / cell_m3_ - 0.5, left = std::floor(place), part = place - left;
    const auto i = static_cast<Eigen::Index>(left);
    return (1 - part) * at_cell(i) + part * at_cell(i + 1);
  }

 private:
  double at_cell(Eigen::Index i) const {
    const Eigen::Index from = std::max<Eigen::Index>(i - half_, 0),
                       to = std::min<Eigen::Index>(i + half_ + 1, cells_.size());
    if (from >= to) return 0;
    return cells_.segment(from, to - from).dot(weights_.segment(from - i + half_, to - from));
  }
  const VectorXd& cells_;
  double cell_m3_;
  Eigen::Index half_;
  VectorXd weights_;
};

curves::Curves densities_of(const Setup& setup, const Beat& beat, const Film& film, const std::vector<Way>& ways) {
  const Inlet inlet(setup, beat, film);
  double least = inlet.all_m3() / 400;
  for (const Way& way : ways) least = std::min(least, of_spread * std::sqrt(way.variance_m6));
  const double cell = std::max(least, inlet.all_m3() / 6000);
  const VectorXd cells = inlet.cells(cell);
  VectorXd passed(film.time_s.size());
  for (Eigen::Index k = 0; k < passed.size(); ++k) passed[k] = inlet.volume_m3(inlet.true_time(film.time_s[k]));
  curves::Curves out;
  for (const Way& way : ways) {
    const Smeared smeared(cells, cell, std::sqrt(way.variance_m6));
    VectorXd curve(passed.size());
    // k c A is a length: in the file's mm.
    for (Eigen::Index k = 0; k < curve.size(); ++k)
      curve[k] = way.m4_per_kg * smeared.at(passed[k] - way.volume_m3) / 1e-3;
    out.push_back(curve);
  }
  VectorXd mean = VectorXd::Zero(passed.size());
  for (const VectorXd& curve : out) mean += curve / static_cast<double>(out.size());
  for (VectorXd& curve : out) curve.array() += setup.glare_share * mean.array() + setup.glare_m / 1e-3;
  return out;
}

}  // namespace

std::vector<curves::Curves> densities(const Setup& setup) {
  const std::vector<Way> all = ways(setup);
  const Beat beat = with_steps(setup.sampled, setup.steps);
  std::vector<curves::Curves> out;
  for (const Film& film : setup.films) out.push_back(densities_of(setup, beat, film, all));
  return out;
}

}  // namespace ostium::data::density
