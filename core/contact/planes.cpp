/// Ties to walls: an active set, settled within the solve.
#include <algorithm>
#include <cmath>

#include "core/binding/nest.h"
#include "core/contact/contact.h"
#include "core/contact/friction.h"
#include "core/contact/walls.h"
#include "core/math/rotation.h"
#include "core/rod/nodes.h"
#include "core/solve/node_spring.h"
#include "core/tunables.h"

namespace ostium {

namespace {

/// Puts node i back to where it is free, and ties it to its active planes.
void renew_node(int i, const ContactScratch& c, RodScratch& s) {
  S3<double> P = load6<double>(c.free_compliance, i);
  V3<double> target = load3<double>(c.free_target, i);
  const NodeWalls& walls = c.walls[i];
  for (int k = 0; k < walls.count; ++k) {
    const WallPlane& w = walls.planes[k];
    if (!w.active) continue;
    tie(w.normal, w.place, w.softness, P, target);
    if (w.stay > 0) tie(w.across, w.beside, 1 / w.stay, P, target);
  }
  if (c.rubs[i]) rub(i, c, s, P, target);
  move_target(i, target - load3<double>(s.target, i), s);
  store6(s.chain.compliance, i, P);
}

bool is_touched(const ContactScratch& c, int i) {
  bool any = c.rubs[i];
  for (int k = 0; k < c.walls[i].count; ++k) any = any || c.walls[i].planes[k].active;
  return any;
}

/// What of the last step's force each plane gave: most from the one that faces it best, of the rest the next, so that
/// planes beside those that hold a node are not thought to.
void share_force(V3<double> force, const NodeWalls& walls, double* pressed_N) {
  std::fill(pressed_N, pressed_N + walls.count, 0.0);
  for (int round = 0; round < walls.count; ++round) {
    int most = 0;
    for (int k = 1; k < walls.count; ++k)
      if (dot(force, walls.planes[k].normal) > dot(force, walls.planes[most].normal)) most = k;
    const double part = dot(force, walls.planes[most].normal);
    if (!(part > 0)) return;
    pressed_N[most] += part;
    force = madd(-part, walls.planes[most].normal, force);
  }
}

int most_changes(const ContactScratch& c) { return c.wary ? tunables::max_wary_changes : tunables::max_wall_changes; }

double push_N(const WallPlane& w, const V3<double>& p) { return (w.place - dot(w.normal, p)) / w.softness; }

}  // namespace

void expect_touches(const Strand& strand) {
  ContactScratch& c = *strand.contact;
  if (c.walls.empty()) return;
  const RodScratch& s = *strand.s;
  const RodState& own = *strand.own;
  for (int i = s.inside.first; i < s.inside.nodes(); ++i) {
    NodeWalls& walls = c.walls[i];
    c.rubs[i] = false;
    if (walls.count == 0) continue;
    const V3<double> expected = load3<double>(s.position, i);
    double pressed[max_planes];
    const V3<double> force = load3<double>(own.wall_force, i);
    if (c.wary)
      for (int k = 0; k < walls.count; ++k) pressed[k] = largest(0, dot(force, walls.planes[k].normal));
    else
      share_force(force, walls, pressed);
    for (int k = 0; k < walls.count; ++k) {
      WallPlane& w = walls.planes[k];
      w.active = dot(w.normal, expected) - pressed[k] / tunables::press_N_m < w.place;
      w.stay = w.active ? pressed[k] * w.curvature : 0;
      w.beside = dot(w.across, load3<double>(own.position, i) + w.carried);
    }
    find_rubbing(own, i, walls, s, c);
  }
}

void tie_to_walls(const Strand& strand) {
  ContactScratch& c = *strand.contact;
  if (c.walls.empty()) return;
  RodScratch& s = *strand.s;
  c.free_compliance = s.chain.compliance;
  c.free_target = s.target;
  c.changes = 0;
  for (int i = s.inside.first; i < s.inside.nodes(); ++i)
    if (is_touched(c, i)) renew_node(i, c, s);
}

bool change_walls(const Model& model, const Strand& strand, Scratch& scratch) {
  ContactScratch& c = *strand.contact;
  if (c.walls.empty() || c.changes >= most_changes(c)) return false;
  RodScratch& s = *strand.s;
  const RodState& own = *strand.own;
  const bool may_release = c.changes < most_changes(c) / 2;  // later on, so that no node comes and goes
  bool any = false;
  for (int i = first_free(s); i <= last_free(s); ++i) {
    NodeWalls& walls = c.walls[i];
    const V3<double> p = solved_position(s, i);
    bool changed = false;
    for (int k = 0; k < walls.count; ++k) {
      WallPlane& w = walls.planes[k];
      if (w.active ? may_release && push_N(w, p) < -tunables::wall_pull_N
                   : dot(w.normal, p) < w.place - tunables::wall_loose_m) {
        w.active = !w.active, w.stay = 0;
        changed = true;
      }
    }
    if (!changed && model.sweep) {
      const V3<double> moved = p - load3<double>(own.position, i);
      const V3<double> slid = walls.count > 0 ? moved - walls.planes[0].carried : moved;
      const double far = walls.count > 0 ? least(c.travel.at(0)[i], tunables::slid_far_m) : c.travel.at(0)[i];
      if (dot(slid, slid) > far * far) changed = follow(model, own, i, p, scratch, s, c);
    }
    if (changed) renew_node(i, c, s);
    any = any || changed;
  }
  c.changes += any;
  return any;
}

bool gave_up_releasing(const Strand& strand) {
  return !strand.contact->walls.empty() && strand.contact->changes > most_changes(*strand.contact) / 2;
}

double behind_walls(const Strand& strand) {
  const ContactScratch& c = *strand.contact;
  if (c.walls.empty()) return 0;
  double most = 0;
  for (int i = first_free(*strand.s); i <= last_free(*strand.s); ++i)
    for (int k = 0; k < c.walls[i].count; ++k) {
      const WallPlane& w = c.walls[i].planes[k];
      if (!w.active) most = largest(most, w.place - dot(w.normal, load3<double>(strand.s->position, i)));
    }
  return most;
}

namespace {
V3<double> pushing_force(const RodScratch& s, const ContactScratch& c, int i) {
  V3<double> force{};
  const V3<double> p = load3<double>(s.position, i);
  const NodeWalls& walls = c.walls[i];
  for (int k = 0; k < walls.count; ++k) {
    const WallPlane& w = walls.planes[k];
    if (!w.active) continue;
    force = madd(push_N(w, p), w.normal, force);
    force = madd(w.stay * (w.beside - dot(w.across, p)), w.across, force);
  }
  return force;
}

}  // namespace

void commit_walls(const Model& model, const Strand& strand, std::vector<Touch>& touches) {
  const ContactScratch& c = *strand.contact;
  if (c.walls.empty()) return;
  const RodScratch& s = *strand.s;
  RodState& own = *strand.own;
  for (int i = s.inside.first; i < s.inside.nodes(); ++i) {
    const bool free = c.walls[i].count == 0;
    const V3<double> force = free ? V3<double>{} : pushing_force(s, c, i), last = load3<double>(own.wall_force, i);
    const double push = std::sqrt(dot(force, force));
    if (push > 0 && dot(last, last) == 0) land(i, (1 / push) * force, model.step_s, own);
    const V3<double> rubbed = free ? V3<double>{} : rubbing_force(i, s, c);
    if (free)
      own.wall_slip.set(i, {0, 0});
    else
      take_rubbing(i, s, c, own);
    store3(own.wall_force, i, force);
    if (push == 0) continue;
    const NodeOfRod node = node_of_rod(strand, i);
    touches.push_back({node.rod, node.node, own.position[i] - s.inside.radius.at(0)[i] / push * to_eigen(force),
                       to_eigen(force), to_eigen(rubbed)});
  }
}

}  // namespace ostium
