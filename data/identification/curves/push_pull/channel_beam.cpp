#include "data/identification/curves/push_pull/channel_beam.h"

#include <algorithm>
#include <cmath>

namespace ostium::data::push_pull {

namespace {

constexpr double beyond = 1e-9;      // of the clearance: how far a place may be behind the wall
constexpr double no_force = 1e-12;   // of the largest
constexpr int most_exchanges = 400;  // some ten are usual

/// From one node to the next: compliance and curvature are constant.
struct Cell {
  double length, compliance, curvature;
};

/// A wire in its walls. Nodes are the places where it may touch and where anything changes between them.
class Wire {
 public:
  Wire(const std::vector<Bend>& bends, double from, double spacing, double tip,
       const std::vector<StiffPiece>& stiffness)
      : bends_(bends), stiffness_(stiffness), tip_(tip), piece_(stiffness.size() - 1) {
    std::vector<double> changes;
    for (const Bend& b : bends) changes.push_back(b.at_m), changes.push_back(b.end_m());
    for (std::size_t i = 0; i + 1 < stiffness.size(); ++i) changes.push_back(tip - stiffness[i].to_m);
    std::sort(changes.begin(), changes.end());
    const auto count = static_cast<std::size_t>((tip - from) / spacing) + 2;
    places_.reserve(count), at_.reserve(count + changes.size()), cells_.reserve(count + changes.size());
    auto change = changes.begin();
    for (long k = 0;; ++k) {
      const double place = from + spacing * static_cast<double>(k);
      const bool last = place > tip - spacing / 2;
      for (; change != changes.end() && *change < (last ? tip : place); ++change)
        if (!at_.empty() && *change > at_.back()) add(*change);
      add(last ? tip : place);
      places_.push_back(at_.size() - 1);
      if (last) break;
    }
  }

  std::size_t places() const { return places_.size(); }
  std::size_t node(std::size_t place) const { return places_[place]; }
  double at(std::size_t node) const { return at_[node]; }
  std::size_t nodes() const { return at_.size(); }
  const Cell& cell(std::size_t i) const { return cells_[i]; }  ///< behind node i

 private:
  void add(double at) {
    if (!at_.empty()) {
      const double middle = (at_.back() + at) / 2;
      while (bend_ < bends_.size() && bends_[bend_].end_m() < middle) ++bend_;
      while (piece_ > 0 && tip_ - middle < stiffness_[piece_ - 1].to_m) --piece_;
      const bool bent = bend_ < bends_.size() && bends_[bend_].at_m < middle;
      cells_.push_back({at - at_.back(), 1 / stiffness_[piece_].EI_N_m2, bent ? 1 / bends_[bend_].radius_m : 0});
    }
    at_.push_back(at);
  }

  const std::vector<Bend>& bends_;
  const std::vector<StiffPiece>& stiffness_;
  double tip_;
  std::size_t bend_ = 0, piece_;  ///< of the last cell
  std::vector<double> at_;
  std::vector<Cell> cells_;
  std::vector<std::size_t> places_;  ///< nodes at which it may touch
};

/// A touch while it is sought.
struct Held {
  std::size_t place;
  int side;
  double force = 0;   ///< with which it presses, as long as the set is dual feasible
  double target = 0;  ///< with which it would press if it held with the others
};

class ActiveSet {
 public:
  ActiveSet(const Wire& wire, double clearance) : wire_(wire), clearance_(clearance), w_(wire.nodes()) {}

  std::vector<Held> solve(std::vector<Held> start) {
    held_ = std::move(start);
    if (!warm() && !cold()) return {};
    for (int i = 0; i < most_exchanges; ++i) {
      deflect();
      const auto [place, side] = worst();
      if (side == 0 || !add(place, side)) break;
    }
    return held_;
  }

 private:
  /// Three moments: sets the slope at the first touch, moments at the touches, and targets.
  void balance() {
    const std::size_t m = held_.size();
    moment_.assign(m, 0);
    std::vector<double> P(m, 0), diagonal(m, 0), right(m, 0);
    double first_P = 0, first_turn = 0;
    for (std::size_t j = 0; j + 1 < m; ++j) {
      const std::size_t a = wire_.node(held_[j].place), b = wire_.node(held_[j + 1].place);
      const double L = wire_.at(b) - wire_.at(a);
      double p = 0, q = 0, s = 0, near = 0, far = 0, t = 0;
      for (std::size_t i = a; i < b; ++i) {
        const Cell& c = wire_.cell(i);
        const double dt = c.length / L, to = i + 1 == b ? 1 : t + dt, mean = (t + to) / 2, wide = dt * dt / 12;
        const double e = c.compliance * c.length, k = c.curvature * c.length;
        p += e * (mean * (1 - mean) - wide), q += e * (mean * mean + wide);
        s += e * ((1 - mean) * (1 - mean) + wide), near += k * (1 - mean), far += k * mean;
        t = to;
      }
      const double turn = (held_[j + 1].side - held_[j].side) * clearance_ / L;
      P[j] = p, diagonal[j] += s, diagonal[j + 1] += q;
      right[j] += turn + near, right[j + 1] += far - turn;
      if (j == 0) first_P = p, first_turn = turn + near;
    }
    // Inner touches only; the ends are free.
    std::vector<double> d = diagonal;
    for (std::size_t j = 2; j + 1 < m; ++j) {
      const double f = P[j - 1] / d[j - 1];
      d[j] -= f * P[j - 1], right[j] -= f * right[j - 1];
    }
    for (std::size_t j = m - 1; j-- > 1;) moment_[j] = (right[j] - P[j] * moment_[j + 1]) / d[j];
    slope_ = first_turn - (m > 1 ? first_P * moment_[1] : 0);
    double before = 0;
    for (std::size_t j = 0; j < m; ++j) {
      const double L = j + 1 < m ? wire_.at(wire_.node(held_[j + 1].place)) - wire_.at(wire_.node(held_[j].place)) : 0;
      const double after = j + 1 < m ? (moment_[j + 1] - moment_[j]) / L : 0;
      held_[j].target = held_[j].side * (before - after), before = after;
    }
  }

  /// Deviations at all nodes.
  void deflect() {
    const std::size_t first = wire_.node(held_.front().place);
    double w = held_.front().side * clearance_, slope = slope_;
    w_[first] = w;
    for (std::size_t i = first; i-- > 0;) {
      const Cell& c = wire_.cell(i);
      w -= c.length * (slope + c.length * c.curvature / 2), slope += c.length * c.curvature, w_[i] = w;
    }
    w = w_[first], slope = slope_;
    std::size_t i = first;
    for (std::size_t j = 0; j < held_.size(); ++j) {
      const bool last = j + 1 == held_.size();
      const std::size_t end = last ? wire_.nodes() - 1 : wire_.node(held_[j + 1].place);
      const double shear = last ? 0 : (moment_[j + 1] - moment_[j]) / (wire_.at(end) - wire_.at(i));
      double M = last ? 0 : moment_[j];
      for (; i < end; ++i) {
        const Cell& c = wire_.cell(i);
        const double h = c.length, g = c.compliance * M - c.curvature, change = c.compliance * shear * h;
        w += h * (slope + h * (g / 2 + change / 6)), slope += h * (g + change / 2), M += shear * h;
        w_[i + 1] = w;
      }
    }
  }

  /// The place that is furthest beyond a wall, and which wall; side 0: none.
  std::pair<std::size_t, int> worst() const {
    std::pair<std::size_t, int> out{0, 0};
    double most = clearance_ * (1 + beyond);
    for (std::size_t k = 0; k < wire_.places(); ++k) {
      const double w = w_[wire_.node(k)];
      if (std::fabs(w) > most) most = std::fabs(w), out = {k, w > 0 ? 1 : -1};
    }
    return out;
  }

  double least_force() const {
    double largest = 0;
    for (const Held& h : held_) largest = std::max(largest, std::fabs(h.target));
    return no_force * largest;
  }

  /// Adds a touch, and takes out those that would pull; false if rounding leaves nothing to gain.
  bool add(std::size_t place, int side) {
    const auto next = std::find_if(held_.begin(), held_.end(), [&](const Held& h) { return h.place >= place; });
    if (next != held_.end() && next->place == place) return false;
    held_.insert(next, {place, side});
    for (;;) {
      balance();
      const double least = least_force();
      double part = 1;
      std::size_t out = held_.size();
      for (std::size_t j = 0; j < held_.size(); ++j) {
        const Held& h = held_[j];
        if (h.target > least) continue;
        if (h.place == place) {
          held_.erase(held_.begin() + static_cast<std::ptrdiff_t>(j));
          balance();
          return false;
        }
        const double reach = h.force > h.target ? h.force / (h.force - h.target) : 0;
        if (reach <= part) part = reach, out = j;
      }
      for (Held& h : held_) h.force += part * (h.target - h.force);
      if (out == held_.size()) return true;
      held_.erase(held_.begin() + static_cast<std::ptrdiff_t>(out));
    }
  }

  /// From touches of a similar wire: those that press.
  bool warm() {
    while (held_.size() >= 3) {
      balance();
      const auto weakest = std::min_element(held_.begin(), held_.end(),
                                            [](const Held& a, const Held& b) { return a.target < b.target; });
      if (weakest->target > least_force()) {
        for (Held& h : held_) h.force = h.target;
        return true;
      }
      held_.erase(weakest);
    }
    return false;
  }

  /// From three touches that a wire which is not bent cannot do without; false if it can.
  bool cold() {
    // What is not bent has the form -kappa, so against its chord it is furthest out at one place.
    held_ = {{0, 1}, {wire_.places() - 1, 1}};
    balance(), deflect();
    double most = 0;
    std::size_t place = 0;
    for (std::size_t k = 1; k + 1 < wire_.places(); ++k)
      if (const double off = w_[wire_.node(k)] - clearance_; off > most) most = off, place = k;
    if (most <= 2 * clearance_ * (1 + beyond)) return false;
    held_ = {{0, -1}, {place, 1}, {wire_.places() - 1, -1}};
    balance();
    for (Held& h : held_) h.force = h.target;
    return true;
  }

  const Wire& wire_;
  double clearance_, slope_ = 0;
  std::vector<double> w_, moment_;
  std::vector<Held> held_;
};

}  // namespace

ChannelBeam::ChannelBeam(std::vector<Bend> bends, double from_m, double spacing_m)
    : bends_(std::move(bends)), from_m_(from_m), spacing_m_(spacing_m) {}

std::vector<WallForce> ChannelBeam::forces(double tip_m, double clearance_m, const std::vector<StiffPiece>& stiffness,
                                           std::vector<Touch>& touches) const {
  std::vector<WallForce> out;
  if (bends_.empty() || tip_m < bends_.front().at_m) {
    touches.clear();
    return out;
  }
  const Wire wire(bends_, from_m_, spacing_m_, tip_m, stiffness);
  const std::size_t last = wire.places() - 1;
  std::vector<Held> start;
  for (const Touch& t : touches) {
    const std::size_t place = t.place == at_tip ? last : static_cast<std::size_t>(t.place);
    if (t.place == at_tip || place < last) start.push_back({place, t.side});
  }
  touches.clear();
  for (const Held& h : ActiveSet(wire, clearance_m).solve(std::move(start))) {
    touches.push_back({h.place == last ? at_tip : static_cast<long>(h.place), h.side});
    out.push_back({wire.at(wire.node(h.place)), h.target});
  }
  return out;
}

}  // namespace ostium::data::push_pull
