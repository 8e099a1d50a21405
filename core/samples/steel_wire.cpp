#include "core/samples/steel_wire.h"

#include <Eigen/Geometry>

#include "core/base/units.h"
#include "core/rod/initial_state.h"

namespace ostium::core {

Bench::Bench(Model m, const EndState& base) : model(std::move(m)), state(make_state(model, {base})), scratch(model) {
  inputs.rods.resize(1);
}

void Bench::step() { core::step(model, inputs, state, scratch, report); }

RodEquilibrium Bench::settle() {
  std::vector<RodEquilibrium> result;
  find_equilibrium(model, inputs, state, scratch, result);
  return result[0];
}

bool Bench::is_unstable() { return negative_directions(model, inputs, state, 0, scratch) > 0; }

RodDescription steel_wire(const WireOptions& o) {
  RodDescription wire;
  wire.name = "steel wire";
  wire.sections = {round_section(0, o.length_m, 0.45e-3, 0, o.E_Pa, 0.3, 6500)};
  wire.element_lengths_m = equal_elements(wire.sections, o.elements);
  return wire;
}

Bench bench_of(const RodDescription& rod, bool gravity) {
  Model model;
  model.rods.push_back(make_rod(rod));
  if (!gravity) model.gravity_W.setZero();
  return Bench(std::move(model), along_x());
}

Bench steel_bench(const WireOptions& o) { return bench_of(steel_wire(o), o.gravity); }

EndState along_x() {
  EndState end;
  end.q_W = turned_frame({1, 0, 0, 0}, Eigen::Vector3d(0, units::pi / 2, 0));
  return end;
}

Eigen::Vector4d turned_frame(const Eigen::Vector4d& q_W, const Eigen::Vector3d& rotation_W_rad) {
  const double angle = rotation_W_rad.norm();
  if (angle == 0) return q_W;
  const Eigen::Quaterniond q =
      Eigen::AngleAxisd(angle, rotation_W_rad / angle) * Eigen::Quaterniond(q_W[0], q_W[1], q_W[2], q_W[3]);
  return {q.w(), q.x(), q.y(), q.z()};
}

void lay_out(const Rod& rod, const std::vector<Eigen::Vector4d>& q_W, const Eigen::Vector4d& tip_q_W, RodState& state) {
  Eigen::Vector3d r = state.base.p_W;
  for (int j = 0; j < rod.elements; ++j) {
    const Eigen::Vector4d& q = q_W[j];
    state.position.set(j, r);
    state.orientation.set(j, q);
    state.force.set(j, Eigen::Vector3d::Zero());
    state.turn.set(j, Eigen::Vector3d::Zero());
    state.turn_before.set(j, Eigen::Vector3d::Zero());
    r += rod.length.at(0)[j] * (Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * Eigen::Vector3d::UnitZ());
  }
  state.position.set(rod.elements, r);
  state.position_before = state.position;
  state.velocity.fill(Eigen::Vector3d::Zero());
  state.velocity_before.fill(Eigen::Vector3d::Zero());
  state.tip.p_W = r;
  state.tip.q_W = tip_q_W;
  state.base.hold = state.tip.hold = std::nullopt;
}

void lay_out_ring(const Rod& rod, double twist_rad, RodState& state) {
  const int N = rod.elements;
  const auto frame = [&](double fraction) {  // twisted about d3 (x) first, then turned in the plane (about y)
    const Eigen::Vector4d twisted = turned_frame(along_x().q_W, Eigen::Vector3d(twist_rad * fraction, 0, 0));
    return turned_frame(twisted, Eigen::Vector3d(0, 2 * units::pi * fraction, 0));
  };
  std::vector<Eigen::Vector4d> frames;
  for (int j = 0; j < N; ++j) frames.push_back(frame((j + 0.5) / N));
  lay_out(rod, frames, frame(1), state);
}

}  // namespace ostium::core
