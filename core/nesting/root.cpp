/// Where a branch begins: at the last node of its trunk, joined to the frames of the trunk's last element.
#include "core/math/rotation.h"
#include "core/nesting/nest.h"

namespace ostium::core {

void weigh_root(const Nest& branch, Nest& trunk) {
  Rod& chain = trunk.s.inside;
  chain.joint_length.at(0)[chain.elements] += branch.s.inside.length.at(0)[0] / 2;
  if (!trunk.moved) return;
  chain.mass.at(0)[chain.elements] += branch.s.inside.mass.at(0)[0];
  for (int k = 0; k < branch.layer_count; ++k)
    trunk.layers[branch.beside[k]].mass.at(0)[chain.elements] += branch.layers[k].mass.at(0)[0];
}

void gather_root(Nest& branch) {
  const Nest& trunk = *branch.trunk;
  const int tip = trunk.s.inside.elements;
  const auto take = [&](const Field<3>& from, Field<3>& to) { store3(to, 0, load3<double>(from, tip)); };
  take(trunk.own.position, branch.own.position), take(trunk.own.position_before, branch.own.position_before);
  take(trunk.own.velocity, branch.own.velocity), take(trunk.own.velocity_before, branch.own.velocity_before);
  for (Field<3>* f : {&branch.own.strain, &branch.own.strain_before, &branch.own.wall_force, &branch.own.rod_force})
    if (f->size() > 0) store3(*f, 0, V3<double>{});
}

void turn_root(Nest& branch) {
  const Nest& trunk = *branch.trunk;
  const int last = trunk.s.inside.elements - 1;
  for (int k = 0; k < branch.layer_count; ++k) {
    const Layer& beside = trunk.layers[branch.beside[k]];
    branch.layers[k].base_frame = load4<double>(beside.orientation, last);
    branch.layers[k].base_turn = load3<double>(beside.turn, last);
  }
}

void hold_root(Nest& branch) {
  const Nest& trunk = *branch.trunk;
  store3(branch.s.target, 0, load3<double>(trunk.s.target, trunk.s.inside.elements));
  store6(branch.s.chain.compliance, 0, S3<double>{});
}

void join_root(Nest& branch) {
  branch.fork.chain = &branch.s.chain, branch.fork.factors = &branch.factors;
  branch.fork.joint_count = branch.layer_count;
  for (int k = 0; k < branch.layer_count; ++k) {
    const Layer& layer = branch.layers[k];
    const Q4<double> own = load4<double>(layer.roll < 0 ? branch.s.orientation : layer.orientation, 0);
    branch.fork.joints[k] = {branch.trunk->layers[branch.beside[k]].roll,
                             layer.roll,
                             layer.base_stiffness,
                             layer.base_moment,
                             director3(layer.base_frame),
                             director3(own)};
  }
}

}  // namespace ostium::core
