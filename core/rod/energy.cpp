#include "core/rod/energy.h"

#include "core/math/rotation.h"
#include "core/rod/ends.h"
#include "core/rod/introducer.h"

namespace ostium::core {

Energy energy(const Model& model, const Inputs& inputs, const State& state, std::size_t r) {
  const RodState& s = state.rods[r];
  Rod rod = model.rods[r];
  cut_at_introducer(model.rods[r], s, rod);
  const int N = rod.elements;

  Energy out;
  if (!rod.in_body()) return out;
  const EndJoints ends = joints_of(inputs.rods[r]);
  for (int i = rod.first; i <= N; ++i) {
    if ((i == rod.first && !ends.base) || (i == N && !ends.tip)) continue;
    const Q4<double> a = i == rod.first ? s.base.frame() : load4<double>(s.orientation, i - 1);
    const Q4<double> b = i == N ? s.tip.frame() : load4<double>(s.orientation, i);
    const double length = rod.joint_length.at(0)[i];
    const V3<double> strain = (1 / length) * rotation_vector(conjugate(a) * b) - load3<double>(rod.rest_curvature, i);
    out.elastic_J += length * std::visit([&](const auto& law) { return law.energy(strain, i); }, rod.law);
  }
  for (int i = rod.first; i <= N; ++i) {
    const double mass = rod.mass.at(0)[i];
    out.kinetic_J += 0.5 * mass * s.velocity[i].squaredNorm();
    out.weight_J -= mass * model.gravity_W.dot(s.position[i]);
  }
  return out;
}

}  // namespace ostium::core
