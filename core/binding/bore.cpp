/// The inner rod's side of the binding: ties to the bore, and the rim.
#include <algorithm>
#include <cmath>

#include "core/binding/binding.h"
#include "core/binding/geometry.h"
#include "core/math/rotation.h"
#include "core/rod/nodes.h"
#include "core/solve/node_spring.h"
#include "core/tunables.h"

namespace ostium {

namespace {

/// Direction in which a node, or a point at a rim, is pressed against the bore, and whether it is: its offset, and how
/// far the force that it exerted would have pressed it into a soft wall.
V3<double> pressed(const V3<double>& offset, const V3<double>& force) {
  if (dot(force, offset) < 0) return offset;  // it was held back, not pressed
  return madd(1 / tunables::press_N_m, force, offset);
}

class Enclosing {
 public:
  Enclosing(const Rod& inner, const Rod& outer, const RodScratch& outer_s, const Nesting& nesting, int index,
            const Field<3>& position, BindingScratch& b)
      : inner_(inner), outer_(outer), outer_s_(outer_s), nesting_(nesting), index_(index), position_(position), b_(b) {}

  /// Finds the nodes in this lumen; returns the last of them, or -1.
  int find(int last_free) {
    const double begin = outer_.total_length_m - nesting_.lumen_m;
    int element = outer_.first, last = -1;
    for (int i = inner_.first + 1; i <= last_free; ++i) {
      const double at = depth(inner_, i);
      if (at < begin) continue;
      if (last < 0)
        while (element + 1 < outer_.elements && depth(outer_, element + 1) < at - 2 * outer_.length.at(0)[element])
          ++element;
      const V3<double> r = load3<double>(position_, i);
      double along = project(r, element);
      while (along > 1 && element + 1 < outer_.elements) along = project(r, ++element);
      if (along > 1) break;  // beyond the tip
      if (b_.nesting[i] < 0) {
        b_.nesting[i] = index_, b_.element[i] = element;
        b_.along.at(0)[i] = largest(0, along);  // on the outside of a bend, a node may be beside no element
      }
      last = i;
    }
    return last;
  }

 private:
  double project(const V3<double>& r, int element) const {
    const V3<double> a = load3<double>(outer_s_.position, element),
                     d = load3<double>(outer_s_.position, element + 1) - a;
    return dot(r - a, d) / dot(d, d);
  }

  const Rod &inner_, &outer_;
  const RodScratch& outer_s_;
  const Nesting& nesting_;
  int index_;
  const Field<3>& position_;
  BindingScratch& b_;
};

/// Ties node i along `normal`. Its force turns with it about the lumen's centre, which stays it like a pendulum.
void set_tie(int i, const V3<double>& normal, double force_N, BindingScratch& b) {
  store3(b.normal, i, normal);
  b.softness.at(0)[i] = b.wall.at(0)[i];
  b.stay.at(0)[i] = largest(0, force_N) / largest(b.room.at(0)[i], 1e-9);
}

void find_ties(const Model& model, const Rod& rod, const RodState& state, const std::vector<NestingState>& nestings,
               const Scratch& scratch, BindingScratch& b) {
  for (int i = rod.first; i < rod.nodes(); ++i) {
    b.softness.at(0)[i] = infinite, b.stay.at(0)[i] = 0;
    if (b.nesting[i] < 0) continue;
    const RodScratch& outer = scratch.rods[model.nestings[b.nesting[i]].outer];
    const int element = b.element[i];
    const CentrelinePoint c = centreline(outer.inside, outer, outer.position, element, b.along.at(0)[i]);
    store3(b.centre, i, c.p);
    store3(b.tangent, i, c.tangent);
    b.wall.at(0)[i] = 1 / (tunables::bore_N_m2 * rod.joint_length.at(0)[i]);
    b.room.at(0)[i] = outer.inside.bore.at(0)[element] - rod.radius.at(0)[i];
    const V3<double> now = load3<double>(state.offset, i), next = now + (now - load3<double>(state.offset_before, i));
    V3<double> force = load3<double>(state.contact_force, i);
    // A node that has just come in was pressed as the rim was.
    if (dot(now, now) == 0) force = from_eigen(nestings[b.nesting[i]].rim_force_W_N);
    force = across(c.tangent, force);
    const V3<double> press = pressed(across(c.tangent, next), force);
    const double reach = std::sqrt(dot(press, press));
    if (i > b.last || !(reach > b.room.at(0)[i])) continue;
    const V3<double> n = (1 / reach) * press;
    set_tie(i, n, dot(force, n), b);
  }
}

void find_rim(const Model& model, const State& state, int index, int node, const Rod& rod, const Field<3>& position,
              Scratch& scratch, BindingScratch& b, RodScratch& s) {
  const Nesting& nesting = model.nestings[index];
  const RodScratch& outer = scratch.rods[nesting.outer];
  const Rod& tube = outer.inside;
  Rim& rim = b.rims[b.rim_count];
  rim.nesting = index, rim.node = node;
  const CentrelinePoint tip = centreline(tube, outer, outer.position, tube.elements - 1, 1);
  const V3<double> a = load3<double>(position, node), d = load3<double>(position, node + 1) - a;
  rim.along = std::clamp(dot(tip.tangent, tip.p - a) / dot(tip.tangent, d), 0.0, 1.0);
  const V3<double> point = centreline(rod, s, position, node, rim.along).p;
  const V3<double> bulge = point - madd(rim.along, d, a);
  rim.centre = tip.p - bulge;
  rim.tip = tip.p;
  rim.tangent = tip.tangent;
  rim.room = tube.bore.at(0)[tube.elements - 1] - rod.radius.at(0)[node];
  rim.wall = 2 / (tunables::bore_N_m2 * rod.length.at(0)[node]);
  rim.force_N = 0;
  // It is pressed as it was, there or at the node that has just left.
  V3<double> press = from_eigen(state.nestings[index].rim_force_W_N) +
                     load3<double>(state.rods[nesting.inner].contact_force, node + 1);
  press = across(tip.tangent, press);
  rim.edge = d;
  rim.stay = std::sqrt(dot(press, press)) / rim.room;
  if (rim.stay == 0) press = across(tip.tangent, point - tip.p);
  const double reach = std::sqrt(dot(press, press));
  rim.normal = reach > 0 ? (1 / reach) * press : director1(load4<double>(outer.orientation, tube.elements - 1));
  ++b.rim_count;
}

/// What is in a bore, and what the rim holds, no wall does.
void hold(ContactScratch& contact, const BindingScratch& b, const Rod& rod) {
  if (contact.held.empty()) return;
  for (int i = rod.first; i < rod.nodes(); ++i)
    if (b.nesting[i] >= 0) contact.held[i] = true;
  for (int k = 0; k < b.rim_count; ++k) contact.held[b.rims[k].node + 1] = true;
}

}  // namespace

void hold_enclosed(const Model& model, std::size_t r, Scratch& scratch) {
  ContactScratch& contact = scratch.contacts[r];
  if (contact.held.empty()) return;
  const Rod& rod = scratch.rods[r].inside;
  std::fill(contact.held.begin(), contact.held.end(), 0);
  for (const Nesting& n : model.nestings) {
    if (n.inner != static_cast<int>(r) || !is_bound(n, scratch)) continue;
    const double tip = scratch.rods[n.outer].inside.total_length_m;
    for (int i = rod.first; i < rod.nodes(); ++i) {
      const double at = depth(rod, i), one_more = i > rod.first ? rod.length.at(0)[i - 1] : 0;
      if (at >= tip - n.lumen_m && at - one_more <= tip) contact.held[i] = true;
    }
  }
}

void find_bores(const Model& model, const State& state, std::size_t r, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  if (b.nesting.empty()) return;
  RodScratch& s = scratch.rods[r];
  const Field<3>& position = s.position;
  const Rod& rod = s.inside;
  std::fill(b.nesting.begin(), b.nesting.end(), -1);
  b.rim_count = 0;
  // The last rod's lumen first: it is the innermost.
  for (int index = static_cast<int>(model.nestings.size()) - 1; index >= 0; --index) {
    const Nesting& nesting = model.nestings[index];
    if (nesting.inner != static_cast<int>(r) || !is_bound(nesting, scratch)) continue;
    const RodScratch& outer = scratch.rods[nesting.outer];
    Enclosing lumen(rod, outer.inside, outer, nesting, index, position, b);
    const int last = lumen.find(rod.elements);
    if (last >= 0 && last < rod.elements && b.nesting[last] == index && b.nesting[last + 1] < 0)
      find_rim(model, state, index, last, rod, position, scratch, b, s);
  }
  hold(scratch.contacts[r], b, rod);
  b.last = s.inputs.tip.hold == Hold::free ? rod.elements : rod.elements - 1;
  find_ties(model, rod, state.rods[r], state.nestings, scratch, b);
}

namespace {

/// Puts node i back to where it is free, and ties it again if it is tied; keeps the chain's gaps in step.
void renew_node(int i, BindingScratch& b, RodScratch& s) {
  S3<double> P = load6<double>(b.free_compliance, i);
  V3<double> target = load3<double>(b.free_target, i);
  if (b.softness.at(0)[i] < infinite) {
    const V3<double> n = load3<double>(b.normal, i), e = cross(load3<double>(b.tangent, i), n);
    const V3<double> centre = load3<double>(b.centre, i);
    tie(n, dot(n, centre) + b.room.at(0)[i], b.softness.at(0)[i], P, target);
    tie(e, dot(e, centre), 1 / b.stay.at(0)[i], P, target);
  }
  if (b.slide_stiffness.at(0)[i] > 0)
    tie(load3<double>(b.tangent, i), b.slide_place.at(0)[i], 1 / b.slide_stiffness.at(0)[i], P, target);
  for (int k = 0; k < b.rim_count; ++k) {
    const Rim& rim = b.rims[k];
    if (i != rim.node && i != rim.node + 1) continue;
    const double part = i == rim.node ? 1 - rim.along : rim.along;
    const V3<double> e = cross(rim.tangent, rim.normal);
    const V3<double> beside = i == rim.node ? -rim.along * rim.edge : (1 - rim.along) * rim.edge;
    tie(e, dot(e, rim.centre + beside), 1 / (part * rim.stay), P, target);
  }
  move_target(i, target - load3<double>(s.target, i), s);
  store6(s.chain.compliance, i, P);
}

}  // namespace

void tie_to_bores(std::size_t r, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  if (b.nesting.empty()) return;
  RodScratch& s = scratch.rods[r];
  for (int k = 0; k < b.rim_count; ++k) b.rims[k].force_N = 0;
  b.free_compliance = s.chain.compliance;
  b.free_target = s.target;
  b.changes = 0;
  for (int i = s.inside.first; i < s.inside.nodes(); ++i)
    if (b.softness.at(0)[i] < infinite || b.slide_stiffness.at(0)[i] > 0) renew_node(i, b, s);
  for (int k = 0; k < b.rim_count; ++k)
    for (int i : {b.rims[k].node, b.rims[k].node + 1}) renew_node(i, b, s);
}

bool change_ties(std::size_t r, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  if (b.nesting.empty() || b.changes >= tunables::max_tie_changes) return false;
  RodScratch& s = scratch.rods[r];
  const Chain& chain = s.chain;
  const bool may_release = b.changes < tunables::max_tie_changes / 2;  // later on, so that no node comes and goes
  bool any = false;
  for (int i = chain.first; i <= b.last; ++i) {
    if (b.nesting[i] < 0) continue;
    const V3<double> offset = across(load3<double>(b.tangent, i), solved_position(s, i) - load3<double>(b.centre, i));
    const double room = b.room.at(0)[i];
    const double reach = std::sqrt(dot(offset, offset));
    double force = 0;
    if (b.softness.at(0)[i] < infinite) {
      force = (dot(load3<double>(b.normal, i), offset) - room) / b.softness.at(0)[i];
      if (may_release && force < -tunables::least_pull_N) {
        b.softness.at(0)[i] = infinite;
        renew_node(i, b, s);
        any = true;
        continue;
      }
    }
    if (!(reach > room + largest(0, force) * b.wall.at(0)[i] + tunables::loose_m)) continue;
    set_tie(i, (1 / reach) * offset, force, b);
    renew_node(i, b, s);
    any = true;
  }
  for (int k = 0; k < b.rim_count; ++k) {
    Rim& rim = b.rims[k];
    const V3<double> point =
        (1 - rim.along) * solved_position(s, rim.node) + rim.along * solved_position(s, rim.node + 1);
    const V3<double> offset = across(rim.tangent, point - rim.centre);
    const double reach = std::sqrt(dot(offset, offset));
    if (!(reach > rim.room + rim.wall * rim.force_N + tunables::loose_m)) continue;
    rim.normal = (1 / reach) * offset;
    rim.stay = rim.force_N / rim.room;
    any = true;
  }
  if (!any) return false;
  ++b.changes;
  for (int k = 0; k < b.rim_count; ++k) {
    Rim& rim = b.rims[k];
    rim.force_N = 0;
    for (int i : {rim.node, rim.node + 1}) renew_node(i, b, s);
  }
  return true;
}

bool is_inner(const Scratch& scratch, std::size_t r) { return !scratch.bindings[r].nesting.empty(); }

int rim_count(const Scratch& scratch, std::size_t r) { return scratch.bindings[r].rim_count; }

namespace {
/// What a unit force along the rim's normal moves nodes by, at its two nodes, without internal force.
struct RimPush {
  V3<double> before, after;
  RimPush(const Rim& rim, const Chain& chain)
      : before((1 - rim.along) * (load6<double>(chain.compliance, rim.node) * rim.normal)),
        after(rim.along * (load6<double>(chain.compliance, rim.node + 1) * rim.normal)) {}
};

/// Along the rim's normal, of its point, when nodes are at `target` + P (internal force).
double rim_move(const Rim& rim, const Chain& chain, const Field<3>& force, const V3<double>& before,
                const V3<double>& after) {
  const auto node = [&](int i, const V3<double>& target) {
    return dot(rim.normal,
               target + load6<double>(chain.compliance, i) * node_force(force, chain.first, chain.elements, i));
  };
  return (1 - rim.along) * node(rim.node, before) + rim.along * node(rim.node + 1, after);
}
}  // namespace

ChainLoad& rim_load(std::size_t r, int k, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  const Chain& chain = scratch.rods[r].chain;
  ChainLoad& load = b.rim_loads[k];
  const Rim& rim = b.rims[k];
  std::fill(load.torque.raw().begin(), load.torque.raw().end(), 0.0);
  std::fill(load.gap.raw().begin(), load.gap.raw().end(), 0.0);
  const RimPush push(rim, chain);
  const auto add = [&](int j, const V3<double>& u) {
    if (j >= chain.first && j < chain.elements) store3(load.gap, j, load3<double>(load.gap, j) + u);
  };
  add(rim.node - 1, V3<double>{} - push.before);
  add(rim.node, push.before - push.after);
  add(rim.node + 1, push.after);
  return load;
}

void take_rim_loads(std::size_t r, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  RodScratch& s = scratch.rods[r];
  Chain& chain = s.chain;
  double at[max_outer_rods], yield[max_outer_rods][max_outer_rods], change[max_outer_rods] = {};
  for (int k = 0; k < b.rim_count; ++k) {
    const Rim& rim = b.rims[k];
    at[k] = rim_move(rim, chain, chain.force, load3<double>(s.target, rim.node), load3<double>(s.target, rim.node + 1));
    for (int l = 0; l < b.rim_count; ++l) {
      const RimPush push(b.rims[l], chain);
      const auto pushed = [&](int node) {
        return node == b.rims[l].node ? push.before : node == b.rims[l].node + 1 ? push.after : V3<double>{};
      };
      yield[k][l] = rim_move(rim, chain, b.rim_loads[l].force, pushed(rim.node), pushed(rim.node + 1));
    }
  }
  // Forces push inwards only: Gauss-Seidel over one to three numbers.
  for (int sweep = 0; sweep < (b.rim_count > 1 ? 50 : 1); ++sweep)
    for (int k = 0; k < b.rim_count; ++k) {
      Rim& rim = b.rims[k];
      double point = at[k];
      for (int l = 0; l < b.rim_count; ++l) point -= yield[k][l] * change[l];
      const double place = dot(rim.normal, rim.centre) + rim.room;
      change[k] = largest(
          -rim.force_N, change[k] + (point - place - rim.wall * (rim.force_N + change[k])) / (yield[k][k] + rim.wall));
    }
  for (int k = 0; k < b.rim_count; ++k) {
    Rim& rim = b.rims[k];
    if (change[k] == 0) continue;
    const RimPush push(rim, chain);
    move_target(rim.node, -change[k] * push.before, s);
    move_target(rim.node + 1, -change[k] * push.after, s);
    rim.force_N += change[k];
    const ChainLoad& load = b.rim_loads[k];
    for_packs(chain.first, chain.elements, [&]<class T>(T, int j) {
      const T c = splat<T>(-change[k]);
      store3(chain.turn, j, madd(c, load3<T>(load.turn, j), load3<T>(chain.turn, j)));
      store3(chain.force, j, madd(c, load3<T>(load.force, j), load3<T>(chain.force, j)));
    });
  }
}

void move_bores(const Model& model, std::size_t r, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  RodScratch& s = scratch.rods[r];
  const Rod& rod = s.inside;
  for (int i = rod.first; i < rod.nodes(); ++i) {
    if (b.nesting[i] < 0) continue;
    const RodScratch& outer = scratch.rods[model.nestings[b.nesting[i]].outer];
    const CentrelinePoint c = centreline(outer.inside, outer, outer.position, b.element[i], b.along.at(0)[i]);
    store3(b.centre, i, c.p);
    store3(b.tangent, i, c.tangent);
    if (b.softness.at(0)[i] == infinite) continue;
    const V3<double> n = across(c.tangent, load3<double>(b.normal, i));
    store3(b.normal, i, (1 / std::sqrt(dot(n, n))) * n);
  }
  for (int k = 0; k < b.rim_count; ++k) {
    Rim& rim = b.rims[k];
    const RodScratch& outer = scratch.rods[model.nestings[rim.nesting].outer];
    const CentrelinePoint tip = centreline(outer.inside, outer, outer.position, outer.inside.elements - 1, 1);
    rim.centre = rim.centre + (tip.p - rim.tip);
    rim.tip = tip.p;
    rim.tangent = tip.tangent;
    const V3<double> n = across(tip.tangent, rim.normal);
    rim.normal = (1 / std::sqrt(dot(n, n))) * n;
  }
}

}  // namespace ostium
