#pragma once
/// Neighbouring nodes of a chain that look for walls together.
#include <bit>

#include "core/contact/narrow_phase.h"
#include "core/model/contact_scratch.h"

namespace ostium::core {

/// One node per SIMD lane, at the beginning of the step; unused lanes reach nothing.
struct NodeBlock {
  static constexpr int most = most_in_block;
  double x[most], y[most], z[most], reach[most];  ///< how near a wall must come to count
  double dx[most], dy[most], dz[most];            ///< expected move
  double far[most];                               ///< reach and the length of that move
  int nodes = 0;

  NodeBlock() {
    for (int k = 0; k < most; ++k) set(k, {}, {}, -1);
  }
  void add(const V3<double>& p, const V3<double>& move, double how_near) { set(nodes++, p, move, how_near); }
  V3<double> at(int k) const { return {x[k], y[k], z[k]}; }
  V3<double> move(int k) const { return {dx[k], dy[k], dz[k]}; }

  /// Which nodes may be near a box in which something lies throughout the step: one bit each.
  unsigned near(const V3<double>& low, const V3<double>& high) const {
    return each(low, high, [this](int k) { return load<Lanes>(far + k); });
  }
  /// Which nodes may be near something that begins in a box and moves like that.
  unsigned near(const V3<double>& low, const V3<double>& high, const ClusterDrift& move) const {
    return each(low, high, [&](int k) {
      const V3<Lanes> past{load<Lanes>(dx + k) - move.drift.x, load<Lanes>(dy + k) - move.drift.y,
                           load<Lanes>(dz + k) - move.drift.z};
      return load<Lanes>(reach + k) + square_root(dot(past, past)) + move.spread;
    });
  }
  /// How far outside of their reach a box lies at the beginning of the step: the least of the nodes without a bit in
  /// `except`. Negative where it is within reach.
  double clearance(const V3<double>& low, const V3<double>& high, unsigned except = 0) const {
    double apart[most];
    for (int k = 0; k < most; k += lane_count)
      store(apart + k, square_root(outside2(low, high, k)) - load<Lanes>(reach + k));
    double least_of_all = 1;
    for (int k = 0; k < nodes; ++k)
      if (!(except >> k & 1U)) least_of_all = least(least_of_all, apart[k]);
    return least_of_all;
  }

 private:
  static constexpr double rounding_m = 1e-9;  ///< rounding margin of a coarse test, before the exact one

  void set(int k, const V3<double>& p, const V3<double>& move, double how_near) {
    x[k] = p.x, y[k] = p.y, z[k] = p.z, reach[k] = how_near;
    dx[k] = move.x, dy[k] = move.y, dz[k] = move.z, far[k] = how_near + norm(move);
  }
  Lanes outside2(const V3<double>& low, const V3<double>& high, int k) const {
    const auto outside = [](Lanes p, double a, double b) { return largest(Lanes{}, largest(a - p, p - b)); };
    const V3<Lanes> away{outside(load<Lanes>(x + k), low.x, high.x), outside(load<Lanes>(y + k), low.y, high.y),
                         outside(load<Lanes>(z + k), low.z, high.z)};
    return dot(away, away);
  }
  template <class Reach>
  unsigned each(const V3<double>& low, const V3<double>& high, Reach&& how_near) const {
    unsigned any = 0;
    for (int k = 0; k < most; k += lane_count) {
      const Lanes within = how_near(k) + rounding_m;
      const Lanes counts = _mm256_and_pd(_mm256_cmp_pd(outside2(low, high, k), within * within, _CMP_LE_OQ),
                                         _mm256_cmp_pd(load<Lanes>(reach + k), Lanes{}, _CMP_GT_OQ));
      any |= static_cast<unsigned>(_mm256_movemask_pd(counts)) << k;
    }
    return any;
  }
};

}  // namespace ostium::core
