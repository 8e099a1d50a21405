#include "core/rod/initial_state.h"

#include "core/math/rotation.h"
#include "core/rod/introducer.h"

namespace ostium::core {

namespace {

/// Lays a rod out from its base; joint i turns by `strain(i)` times its cell's length.
template <class Strain>
RodState lay_out(const Rod& whole, const EndState& base, double inserted_m, Strain&& strain) {
  const int N = whole.elements;
  RodState s;
  s.inserted_m = inserted_m;
  s.first = first_element_for(whole, inserted_m);
  s.exposed = whole.elements;
  const int first = s.first;
  Rod rod = whole;
  cut(whole, inserted_m, first, rod);
  s.position.resize(N + 1);
  s.orientation.resize(N);
  s.turn.resize(N);
  s.turn_before.resize(N);
  s.force.resize(N);
  s.velocity.resize(N + 1);
  s.velocity_before.resize(N + 1);
  Eigen::Quaterniond q = Eigen::Quaterniond(base.q_W[0], base.q_W[1], base.q_W[2], base.q_W[3]).normalized();
  Eigen::Vector3d p = base.p_W;
  s.base.p_W = p, s.base.q_W = {q.w(), q.x(), q.y(), q.z()};
  for (int j = 0; j < first; ++j) s.position.set(j, p), s.orientation.set(j, s.base.q_W);
  for (int i = first; i <= N; ++i) {
    s.position.set(i, p);
    if (i == N) break;
    const Eigen::Vector3d theta = rod.joint_length.at(0)[i] * strain(rod, i);
    if (theta.norm() > 0) q = (q * Eigen::AngleAxisd(theta.norm(), theta.normalized())).normalized();
    s.orientation.set(i, {q.w(), q.x(), q.y(), q.z()});
    p += rod.length.at(0)[i] * (q * Eigen::Vector3d::UnitZ());
  }
  s.position_before = s.position;
  if (rod.damping.material_time_s > 0) {
    s.strain.resize(N + 1);
    for (int i = 0; i <= N; ++i) s.strain.set(i, strain(rod, i));
    s.strain_before = s.strain;
  }
  if (rod.relaxation.any())
    for (Field<3>* f : {&s.crept_fast, &s.crept_slow}) f->resize(N + 1);
  s.tip.p_W = p;
  s.tip.q_W = {q.w(), q.x(), q.y(), q.z()};
  return s;
}

template <class Strain>
State lay_out_all(const Model& model, const std::vector<EndState>& bases, const std::vector<double>& inserted_m,
                  Strain&& strain) {
  State state;
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    const Rod& rod = model.rods[r];
    state.rods.push_back(lay_out(rod, bases.at(r), inserted_m.empty() ? rod.total_length_m : inserted_m.at(r), strain));
  }
  for (const Nesting& n : model.nestings) {
    RodState& inner = state.rods[n.inner];
    for (Field<3>* f : {&inner.contact_force, &inner.offset}) f->resize(model.rods[n.inner].nodes());
    inner.slip.resize(model.rods[n.inner].nodes());
  }
  if (model.rods_touch)
    for (std::size_t r = 0; r < model.rods.size(); ++r) state.rods[r].rod_force.resize(model.rods[r].nodes());
  if (!model.surfaces.empty())
    for (std::size_t r = 0; r < model.rods.size(); ++r) {
      state.rods[r].wall_force.resize(model.rods[r].nodes());
      state.rods[r].wall_slip.resize(model.rods[r].nodes());
    }
  return state;
}

}  // namespace

State make_state(const Model& model, const std::vector<EndState>& bases, const std::vector<double>& inserted_m) {
  return lay_out_all(model, bases, inserted_m,
                     [](const Rod&, int) -> Eigen::Vector3d { return Eigen::Vector3d::Zero(); });
}

State make_state_at_rest_shape(const Model& model, const std::vector<EndState>& bases,
                               const std::vector<double>& inserted_m) {
  return lay_out_all(model, bases, inserted_m,
                     [](const Rod& rod, int i) -> Eigen::Vector3d { return rod.rest_curvature[i]; });
}

}  // namespace ostium::core
