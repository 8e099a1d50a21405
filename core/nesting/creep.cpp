/// Creep of a nest's rods, transferred to the joints of its chain.
#include <algorithm>
#include <cmath>

#include "core/nesting/nest.h"

namespace ostium::core {

namespace {

using Eigen::Vector3d;

/// Creep at a position in units of the rod's own joints, interpolated.
Vector3d crept_at(const Rod& rod, const RodState& own, double place) {
  const double within = std::clamp(place, static_cast<double>(own.first), static_cast<double>(rod.elements));
  const int joint = std::min(static_cast<int>(within), rod.elements - 1);
  const double part = within - joint;
  const auto mixed = [&](const Field<3>& f) -> Vector3d { return (1 - part) * f[joint] + part * f[joint + 1]; };
  const auto& [fast, slow] = rod.relaxation.branches;
  return fast.fraction * mixed(own.crept_fast) + slow.fraction * mixed(own.crept_slow);
}

}  // namespace

void recall_layer_creep(const Model& model, const State& state, Nest& nest) {
  for (int k = 0; k < nest.layer_count; ++k) {
    Layer& layer = nest.layers[k];
    Relaxing* law = std::get_if<Relaxing>(&layer.law);
    if (!law) continue;
    const Rod& rod = model.rods[layer.rod];
    const int joints = std::max(layer.covered, layer.end) + 1;
    if (!rod.relaxation.any()) {
      for (int i = 0; i < joints; ++i) law->crept.set(i, Vector3d::Zero());
      continue;
    }
    // Inside others, its elements lie between those of the chain (`from_own`); joint j comes before element j.
    const auto middle = [&](int e) { return layer.from_own.before[e] + layer.from_own.part.at(0)[e]; };
    for (int i = 0; i < joints; ++i) {
      double place = rod.elements - (layer.end - i);
      if (i < layer.covered)
        place = 0.5 * (middle(std::max(i - 1, 0)) + middle(i)) + 0.5;
      else if (layer.end == 0)
        place = rod.elements;
      law->crept.set(i, crept_at(rod, state.rods[layer.rod], place));
    }
  }
}

}  // namespace ostium::core
