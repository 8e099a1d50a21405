/// Friction at walls, along the rod and around it.
///
/// At the point of contact, -r n from the node, the rod slides along itself as the node does, and around itself,
/// towards e = t x n, by  e . (move of the node) - r (spin).  The spring of core/solver/friction_spring.h acts there:
/// on the node along t and e, and with the torque + r k (slip around) about t on its two elements. Node and spin each
/// use the other's value from the previous iterate.
#include "core/contact/friction.h"

#include <algorithm>

#include "core/base/tolerances.h"
#include "core/contact/contact.h"
#include "core/math/rotation.h"
#include "core/rod/nodes.h"
#include "core/solver/friction_spring.h"
#include "core/solver/node_spring.h"

namespace ostium::core {

namespace {

/// Arc length, m, that the surface has turned about the rod's axis at node i.
double turned(const RodScratch& s, int i) { return s.inside.radius.at(0)[i] * spin_of_node(s, i); }

Slip slip_in(const RodScratch& s, const ContactScratch& c, int i) {
  const V3<double> slid = load3<double>(s.position, i) - load3<double>(c.from, i);
  return {dot(load3<double>(c.along, i), slid), dot(load3<double>(c.across, i), slid) - turned(s, i)};
}

}  // namespace

void find_rubbing(const RodState& own, int i, const NodeWalls& walls, const RodScratch& s, ContactScratch& c) {
  const V3<double> force = load3<double>(own.wall_force, i);
  const double push = std::sqrt(dot(force, force));
  c.rubs[i] = false;
  if (push == 0) return;
  const WallPlane* wall = &walls.planes[0];
  for (int k = 1; k < walls.count; ++k)
    if (dot(walls.planes[k].normal, force) > dot(wall->normal, force)) wall = &walls.planes[k];
  if (wall->friction == 0 || dot(wall->across, wall->across) == 0) return;
  c.rubs[i] = true;
  const V3<double> along = cross(wall->normal, wall->across);
  store3(c.along, i, along);
  store3(c.across, i, wall->across);
  const V3<double> from = load3<double>(own.position, i) + wall->carried;
  store3(c.from, i, madd(-own.wall_slip.at(0)[i], along, madd(-own.wall_slip.at(1)[i], wall->across, from)));
  c.stiffness.at(0)[i] = slip_stiffness(wall->friction, push, tolerances::wall_slip_m, slip_in(s, c, i));
}

void rub(int i, const ContactScratch& c, const RodScratch& s, S3<double>& P, V3<double>& target) {
  const V3<double> along = load3<double>(c.along, i), across = load3<double>(c.across, i),
                   from = load3<double>(c.from, i);
  const double softness = 1 / c.stiffness.at(0)[i];
  tie(along, dot(along, from), softness, P, target);
  tie(across, dot(across, from) + turned(s, i), softness, P, target);
}

void turn_at_walls(const Strand& strand) {
  const ContactScratch& c = *strand.contact;
  if (c.walls.empty()) return;
  RodScratch& s = *strand.s;
  const Rod& rod = s.inside;
  BlockTridiagonal& chain = s.chain;
  for (int i = rod.first; i < rod.nodes(); ++i) {
    if (!c.rubs[i]) continue;
    const double k = c.stiffness.at(0)[i], radius = rod.radius.at(0)[i];
    const double slip = slip_in(s, c, i).around;
    for (int j : {std::max(i - 1, rod.first), std::min(i, rod.elements - 1)}) {
      const V3<double> d3 = director3(load4<double>(s.orientation, j)), kd = (k * radius * radius / 2) * d3;
      store3(chain.torque, j, madd(k * radius * slip / 2, d3, load3<double>(chain.torque, j)));
      const S3<double> K = load6<double>(chain.stiffness, j);
      store6(chain.stiffness, j,
             K + S3<double>{kd.x * d3.x, kd.x * d3.y, kd.x * d3.z, kd.y * d3.y, kd.y * d3.z, kd.z * d3.z});
    }
  }
}

V3<double> rubbing_force(int i, const RodScratch& s, const ContactScratch& c) {
  if (!c.rubs[i]) return {};
  const Slip slip = slip_in(s, c, i);
  const double k = -c.stiffness.at(0)[i];
  return madd(k * slip.along, load3<double>(c.along, i), (k * slip.around) * load3<double>(c.across, i));
}

void take_rubbing(int i, const RodScratch& s, const ContactScratch& c, RodState& own) {
  Slip slip;
  if (c.rubs[i]) slip = kept(slip_in(s, c, i), tolerances::wall_slip_m);
  own.wall_slip.set(i, {slip.along, slip.around});
}

}  // namespace ostium::core
