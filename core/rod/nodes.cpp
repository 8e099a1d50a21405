#include "core/rod/nodes.h"

#include <algorithm>

#include "core/math/rotation.h"

namespace ostium::core {

double spin(const RodScratch& s, int element) {
  return dot(director3(load4<double>(s.orientation, element)), load3<double>(s.turn, element));
}

double spin_of_node(const RodScratch& s, int i) {
  const Rod& rod = s.inside;
  return (spin(s, std::max(i - 1, rod.first)) + spin(s, std::min(i, rod.elements - 1))) / 2;
}

void move_target(int i, const V3<double>& move, RodScratch& s) {
  Field<3>& gap = s.chain.gap;
  if (i > s.chain.first) store3(gap, i - 1, load3<double>(gap, i - 1) - move);
  if (i < s.chain.elements) store3(gap, i, load3<double>(gap, i) + move);
  store3(s.target, i, load3<double>(s.target, i) + move);
}

void guess_nodes(const RodState& state, RodScratch& s) {
  for_packs(s.inside.first, s.inside.nodes(), [&]<class T>(T, int i) {
    const V3<T> r_n = load3<T>(state.position, i);
    const V3<T> move = s.scheme == TimeScheme::from_rest ? V3<T>{} : r_n - load3<T>(state.position_before, i);
    store3(s.position, i, r_n + move);
  });
}

void land(int i, const V3<double>& n, double step_s, RodState& state) {
  const double u = dot(n, load3<double>(state.position, i) - load3<double>(state.position_before, i)) / step_s;
  for (Field<3>* v : {&state.velocity, &state.velocity_before}) {
    const V3<double> was = load3<double>(*v, i);
    store3(*v, i, madd(u - dot(n, was), n, was));
  }
}

}  // namespace ostium::core
