#include "core/rod/iterate.h"

#include <cmath>
#include <limits>

#include "core/base/tolerances.h"
#include "core/math/rotation.h"

namespace ostium::core {

namespace {

/// The maximum of a quantity over a field, and a sum that is finite only if every entry is.
struct Extent {
  Lanes packed_largest{}, packed_sum{};
  double single_largest = 0, single_sum = 0;

  void take(Lanes square) { packed_largest = core::largest(packed_largest, square), packed_sum = packed_sum + square; }
  void take(double square) { single_largest = core::largest(single_largest, square), single_sum += square; }
  double largest() const { return std::sqrt(core::largest(horizontal_max(packed_largest), single_largest)); }
  bool finite() const {
    return std::isfinite(packed_sum[0] + packed_sum[1] + packed_sum[2] + packed_sum[3] + single_sum);
  }
};

template <class T>
V3<T> blend(T fraction, const V3<T>& from, const V3<T>& to) {
  return madd(fraction, to - from, from);
}

}  // namespace

void string_nodes(const Rod& rod, const Field<4>& orientation, V3<double> end, bool from_base, Field<3>& position) {
  const int N = rod.elements;
  for (int k = 0; k <= N - rod.first; ++k) {
    const int node = from_base ? rod.first + k : N - k, element = from_base ? node : node - 1;
    store3(position, node, end);
    if (k == N - rod.first) break;
    const double length = from_base ? rod.length.at(0)[element] : -rod.length.at(0)[element];
    end = madd(length, director3(load4<double>(orientation, element)), end);
  }
}

double largest_turn(const Rod& rod, const BlockTridiagonal& chain) {
  Extent turns;
  for_packs(rod.first, rod.elements, [&]<class T>(T, int j) {
    const V3<T> phi = load3<T>(chain.turn, j);
    turns.take(dot(phi, phi));
  });
  return turns.finite() ? turns.largest() : std::numeric_limits<double>::quiet_NaN();
}

IterateChange measure_solution(const Rod& rod, double max_turn_rad, const BlockTridiagonal& chain) {
  const int N = rod.elements;
  Extent turns, forces;
  for_packs(rod.first, N, [&]<class T>(T, int j) {
    const V3<T> phi = load3<T>(chain.turn, j), n = load3<T>(chain.force, j);
    turns.take(dot(phi, phi)), forces.take(dot(n, n));
  });
  for (int m = 0; m < chain.roll_count; ++m)
    for_packs(rod.first, N, [&]<class T>(T, int j) {
      const T psi = load<T>(chain.rolls[m].turn.at(0) + j);
      turns.take(psi * psi);
    });
  IterateChange change;
  change.finite = turns.finite() && forces.finite();
  if (!change.finite) return change;
  change.turn_rad = turns.largest();
  if (change.turn_rad > max_turn_rad) change.fraction = max_turn_rad / change.turn_rad;
  return change;
}

void apply_solution(const Rod& rod, double fraction, RodScratch& scratch) {
  const BlockTridiagonal& chain = scratch.chain;
  for_packs(rod.first, rod.elements, [&]<class T>(T, int j) {
    const V3<T> phi = splat<T>(fraction) * load3<T>(chain.turn, j);
    store4(scratch.orientation, j, turned(phi, load4<T>(scratch.orientation, j)));
    store3(scratch.turn, j, load3<T>(scratch.turn, j) + phi);
    store3(scratch.force, j, blend(splat<T>(fraction), load3<T>(scratch.force, j), load3<T>(chain.force, j)));
  });
}

void place_nodes(const Rod& rod, const V3<double>& pull, RodScratch& scratch) {
  const int N = rod.elements;
  // Force on node i: that of its distal element minus that of its proximal one.
  const auto node = [&]<class T>(T, int i, const V3<T>& force) {
    store3(scratch.position, i, load3<T>(scratch.target, i) + load6<T>(scratch.chain.compliance, i) * force);
  };
  node(double{}, rod.first, load3<double>(scratch.force, rod.first));
  for_packs(rod.first + 1, N,
            [&]<class T>(T t, int i) { node(t, i, load3<T>(scratch.force, i) - load3<T>(scratch.force, i - 1)); });
  node(double{}, N, pull - load3<double>(scratch.force, N - 1));
}

void measure_defect(const Rod& rod, const RodScratch& scratch, IterateChange& change) {
  Extent stretch, defects;
  for_packs(rod.first, rod.elements, [&]<class T>(T, int j) {
    const T length = load<T>(rod.length.at(0) + j);
    const V3<T> edge = load3<T>(scratch.position, j + 1) - load3<T>(scratch.position, j);
    const V3<T> d3 = director3(load4<T>(scratch.orientation, j));
    const V3<T> strain = (1.0 / length) * edge - d3;
    const T give = tolerances::axial_give_per_N_m * length * dot(load3<T>(scratch.force, j), d3);
    const V3<T> defect = madd(-give, d3, strain);
    stretch.take(dot(strain, strain)), defects.take(dot(defect, defect));
  });
  change.stretch = stretch.largest();
  change.defect = defects.largest();
}

IterateChange update_iterate(const Rod& rod, double max_turn_rad, RodScratch& scratch) {
  IterateChange change = measure_solution(rod, max_turn_rad, scratch.chain);
  if (!change.finite) return change;
  apply_solution(rod, change.fraction, scratch);
  place_nodes(rod, {}, scratch);
  measure_defect(rod, scratch, change);
  return change;
}

}  // namespace ostium::core
