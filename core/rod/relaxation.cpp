#include "core/rod/relaxation.h"

#include <cmath>

#include "core/math/rotation.h"

namespace ostium::core {

void recall_creep(const Rod& rod, const RodState& state, Rod& inside) {
  Relaxing* law = std::get_if<Relaxing>(&inside.law);
  if (!law) return;
  const auto &fast = rod.relaxation.branches[0], &slow = rod.relaxation.branches[1];
  for_packs(0, rod.nodes(), [&]<class T>(T, int i) {
    store3(law->crept, i,
           splat<T>(fast.fraction) * load3<T>(state.crept_fast, i) +
               splat<T>(slow.fraction) * load3<T>(state.crept_slow, i));
  });
}

void creep(const Rod& inside, EndJoints ends, double step_s, RodState& state) {
  if (!inside.relaxation.any() || !inside.in_body()) return;
  const double fast = -std::expm1(-step_s / inside.relaxation.branches[0].time_s),
               slow = -std::expm1(-step_s / inside.relaxation.branches[1].time_s);
  const auto at = [&]<class T>(int i, const Q4<T>& a, const Q4<T>& b) {
    const V3<T> strain = (1.0 / load<T>(inside.joint_length.at(0) + i)) * rotation_vector(conjugate(a) * b) -
                         load3<T>(inside.rest_curvature, i);
    for (auto [field, part] : {std::pair{&state.crept_fast, fast}, {&state.crept_slow, slow}}) {
      const V3<T> before = load3<T>(*field, i);
      store3(*field, i, madd(splat<T>(part), strain - before, before));
    }
  };
  const int first = inside.first, N = inside.elements;
  for_packs(first + 1, N, [&]<class T>(T, int i) {
    at.template operator()<T>(i, load4<T>(state.orientation, i - 1), load4<T>(state.orientation, i));
  });
  if (ends.base) at.operator()<double>(first, state.base.frame(), load4<double>(state.orientation, first));
  if (ends.tip) at.operator()<double>(N, load4<double>(state.orientation, N - 1), state.tip.frame());
}

}  // namespace ostium::core
