/// Ties nodes to walls by an active set that is settled within the solve.
#include <algorithm>
#include <cmath>

#include "core/base/tolerances.h"
#include "core/contact/broad_phase.h"
#include "core/contact/contact.h"
#include "core/contact/friction.h"
#include "core/contact/line_search.h"
#include "core/math/rotation.h"
#include "core/nesting/nest.h"
#include "core/rod/nodes.h"
#include "core/solver/node_spring.h"

namespace ostium::core {

namespace {

/// Resets node i to its contact-free compliance and target, then ties it to its active planes.
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

/// Distributes the last step's wall force among the planes: as much as possible to the plane that faces it best, then
/// the remainder to the next, so that planes beside the ones in contact get none.
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

}  // namespace

void expect_touches(const Model& model, const Strand& strand, Scratch& scratch) {
  ContactScratch& c = *strand.contact;
  if (c.walls.empty()) return;
  const RodScratch& s = *strand.s;
  const RodState& own = *strand.own;
  for (int i = s.inside.first; i < s.inside.nodes(); ++i) {
    NodeWalls& walls = c.walls[i];
    c.rubs[i] = false;
    if (walls.count == 0) continue;
    const V3<double> expected = load3<double>(s.position, i);
    look_again(model, strand, i, expected, scratch);
    double pressed[max_planes];
    share_force(load3<double>(own.wall_force, i), walls, pressed);
    for (int k = 0; k < walls.count; ++k) {
      WallPlane& w = walls.planes[k];
      w.active = dot(w.normal, expected) - pressed[k] / tolerances::press_N_m < w.place;
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
  for (int i = s.inside.first; i < s.inside.nodes(); ++i)
    if (is_touched(c, i)) renew_node(i, c, s);
}

namespace {

/// Whether the node may have met walls that the broad phase did not look at: it looked at those that come nearer than
/// the slack to where the node was expected, or to where it would be if the wall carried it along.
bool went_far(const Strand& strand, int i, const V3<double>& to) {
  constexpr double slack2 = tolerances::wall_slack_m * tolerances::wall_slack_m,
                   slid2 = tolerances::slid_far_m * tolerances::slid_far_m;
  const ContactScratch& c = *strand.contact;
  const NodeWalls& walls = c.walls[i];
  const V3<double> off = to - load3<double>(c.expected, i);
  const bool as_expected = dot(off, off) <= slack2;
  if (walls.count == 0) return !as_expected;
  const V3<double> slid = to - load3<double>(strand.own->position, i) - walls.planes[0].carried;
  const double far2 = dot(slid, slid);
  return far2 > slid2 || (far2 > slack2 && !as_expected);
}

/// Sweeps nodes that moved far through the triangles. True if this adds active walls.
bool follow_far(const Model& model, const Strand& strand, Scratch& scratch) {
  RodScratch& s = *strand.s;
  ContactScratch& c = *strand.contact;
  const RodState& own = *strand.own;
  bool any = false;
  for (int i = first_free(s); i <= last_free(s); ++i) {
    const V3<double> p = load3<double>(c.ahead, i);
    if (!went_far(strand, i, p) || !follow(model, own, i, p, scratch, s, c)) continue;
    c.changed[i] = any = true;
  }
  return any;
}

/// Whether the plane's active flag contradicts the last solution.
bool is_wrong(const WallPlane& w, const V3<double>& ahead) {
  return w.active ? push_N(w, ahead) < -tolerances::wall_pull_N
                  : dot(w.normal, ahead) < w.place - tolerances::wall_loose_m;
}

/// Drops the tie along `across`; its force stays in the line search's anchor.
void drop_stay(int i, WallPlane& w, ContactScratch& c) {
  if (w.stay == 0) return;
  const V3<double> off = load3<double>(c.anchor_push, i);
  const double force = w.stay * (w.beside - dot(w.across, load3<double>(c.anchor, i)));
  store3(c.anchor_push, i, madd(force, w.across, off));
  w.stay = 0;
}

}  // namespace

namespace {

bool any_wrong(const Strand& strand, const ContactScratch& c) {
  const auto [first, last] = settling_nodes(*strand.s, c);
  for (int i = first; i <= last; ++i)
    for (int k = 0; k < c.walls[i].count; ++k)
      if (!c.changed[i] && is_wrong(c.walls[i].planes[k], load3<double>(c.ahead, i))) return true;
  return false;
}

/// Looks at rims anew from where the solution leads; whether a tie contradicts it then, or is gone.
bool any_wrong_now(const Model& model, const Strand& strand, Scratch& scratch) {
  ContactScratch& c = *strand.contact;
  const auto [first, last] = settling_nodes(*strand.s, c);
  bool any_gone = false;
  for (int i = first; i <= last; ++i)
    if (!c.changed[i] && look_again(model, strand, i, load3<double>(c.ahead, i), scratch))
      c.changed[i] = any_gone = true;
  return any_wrong(strand, c) || any_gone;
}

/// Ends the settling of a window's ties: the whole chain's solution is that of its ties.
void leave_window(const Strand& strand, Scratch& scratch) {
  ContactScratch& c = *strand.contact;
  complete(strand.s->chain, scratch.factors);
  c.window_first = c.window_last = -1;
  c.settling = 0;
}

/// After a second change in a row in one short stretch: settles the ties there first.
void enter_window(int first, int last, const Strand& strand, ContactScratch& c) {
  const RodScratch& s = *strand.s;
  first = std::max(first - tolerances::window_margin, first_free(s));
  last = std::min(last + tolerances::window_margin, last_free(s));
  if (c.window_first < 0 && c.changes > 1 && c.settling <= tolerances::quick_wall_changes &&
      last - first <= tolerances::longest_window)
    c.window_first = first, c.window_last = last;
}

/// Changes the ties of a strand that the last solution contradicts; the nodes that this affects.
NodeRange flip_ties(const Strand& strand, bool slow, Scratch& scratch) {
  ContactScratch& c = *strand.contact;
  RodScratch& s = *strand.s;
  const auto [first, last] = settling_nodes(s, c);
  NodeRange affected{last + 1, first - 1};
  for (int i = first; i <= last; ++i) {
    NodeWalls& walls = c.walls[i];
    bool changed = c.changed[i];
    for (int k = 0; k < walls.count; ++k) {
      WallPlane& w = walls.planes[k];
      const bool wrong = slow ? w.active != (dot(w.normal, load3<double>(c.anchor, i)) < w.place)
                              : !c.changed[i] && is_wrong(w, load3<double>(c.ahead, i));
      if (!wrong) continue;
      w.active = !w.active, changed = true;
      ++scratch.counts.flips;
      if (slow)
        drop_stay(i, w, c);
      else
        w.stay = 0;
    }
    if (!changed) continue;
    renew_node(i, c, s);
    affected.first = std::min(affected.first, i), affected.last = i;
  }
  return affected;
}

/// Changes the ties that the last solution contradicts; false if none are.
bool flip_ties(Tree tree, Scratch& scratch) {
  ContactScratch& c = *tree.front().contact;
  const bool slow = c.settling >= tolerances::quick_wall_changes;
  if (c.settling == tolerances::quick_wall_changes)
    start_descent(tree);
  else if (slow)
    descend(tree);
  ++c.changes, ++c.settling, ++scratch.counts.changes;
  const Strand& strand = tree.front();
  auto [first, last] = flip_ties(strand, slow, scratch);
  bool any = first <= last;
  for (const Strand& branch : tree.subspan(1)) {
    const NodeRange affected = flip_ties(branch, slow, scratch);
    if (affected.first > affected.last) continue;
    any = true;
    last = last_free(*strand.s), first = std::min(first, last);  // where it begins is all that the trunk feels of it
  }
  if (!any) return false;
  // A node affects the elements on both sides of it.
  const BlockTridiagonal& chain = strand.s->chain;
  c.same = std::max(0, std::min(first - 1 - chain.first, chain.elements - 1 - last));
  enter_window(first, last, strand, c);
  if (tree.size() > 1 && c.window_first >= 0) c.window_last = last_free(*strand.s);
  return true;
}

}  // namespace

bool change_walls(const Model& model, Tree tree, Scratch& scratch) {
  const Strand& strand = tree.front();
  ContactScratch& c = *strand.contact;
  if (c.walls.empty()) return false;
  const bool spent = c.changes >= tolerances::max_wall_changes;
  for (const Strand& part : tree) {
    std::fill(part.contact->changed.begin(), part.contact->changed.end(), 0);
    look_ahead(part);
  }
  // While many ties settle, the walls stay as they were seen: a trial solution leads to places that are never reached.
  const auto contradicted = [&] {
    const bool quick = c.settling < tolerances::quick_wall_changes;
    bool any = false;
    for (const Strand& part : tree) any |= quick ? any_wrong_now(model, part, scratch) : any_wrong(part, *part.contact);
    return any;
  };
  if (c.window_first >= 0) {
    if (!spent && contradicted()) return flip_ties(tree, scratch);
    leave_window(strand, scratch);
    look_ahead(strand);
  }
  if (spent) return false;
  if (c.settling >= tolerances::quick_wall_changes) {
    if (contradicted()) return flip_ties(tree, scratch);
    c.settling = 0;
  }
  bool met = false;
  for (const Strand& part : tree) met |= model.sweep && follow_far(model, part, scratch);
  return (contradicted() || met) && flip_ties(tree, scratch);
}

namespace {

bool is_pressed(const WallPlane& w, const V3<double>& p) {
  return w.active && !w.soft && w.place - dot(w.normal, p) > tolerances::usable_depth_m;
}

/// Whether a plane that presses a node at p is none of the walls that are there.
bool presses_without_wall(const NodeWalls& walls, const V3<double>& p, const NodeWalls& there) {
  return std::any_of(walls.planes, walls.planes + walls.count, [&](const WallPlane& w) {
    return is_pressed(w, p) && std::none_of(there.planes, there.planes + there.count, [&](const WallPlane& other) {
             return dot(w.normal, other.normal) > tolerances::about_same_wall;
           });
  });
}

}  // namespace

bool find_pressing_walls_anew(const Model& model, const Strand& strand, Scratch& scratch) {
  ContactScratch& c = *strand.contact;
  if (c.walls.empty() || !model.sweep) return false;
  RodScratch& s = *strand.s;
  bool any = false;
  for (int i = first_free(s); i <= last_free(s); ++i) {
    const V3<double> p = load3<double>(s.position, i);
    NodeWalls& walls = c.walls[i];
    if (std::none_of(walls.planes, walls.planes + walls.count, [&](const WallPlane& w) { return is_pressed(w, p); }))
      continue;
    const NodeWalls there = walls_at(model, *strand.own, i, p, scratch, s, c);
    if (!presses_without_wall(walls, p, there)) continue;
    walls = there;
    any = true;
  }
  return any;
}

double behind_walls(const Model& model, const Strand& strand, Scratch& scratch) {
  ContactScratch& c = *strand.contact;
  if (c.walls.empty()) return 0;
  const RodScratch& s = *strand.s;
  double most = 0;
  for (int i = first_free(s); i <= last_free(s); ++i) {
    const V3<double> p = load3<double>(s.position, i);
    for (int k = 0; k < c.walls[i].count; ++k) {
      const WallPlane& w = c.walls[i].planes[k];
      if (!w.active) most = largest(most, w.place - dot(w.normal, p));
    }
    if (model.sweep && went_far(strand, i, p))
      most = largest(most, deeper_than_planes(model, *strand.own, i, p, scratch, s, c));
  }
  return most;
}

namespace {
double depth_in_walls(const RodScratch& s, const ContactScratch& c, int i) {
  double most = 0;
  for (int k = 0; k < c.walls[i].count; ++k) {
    const WallPlane& w = c.walls[i].planes[k];
    if (w.active && !w.soft) most = largest(most, w.place - dot(w.normal, load3<double>(s.position, i)));
  }
  return most;
}

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

void commit_walls(const Strand& strand, StepReport& report) {
  const ContactScratch& c = *strand.contact;
  if (c.walls.empty()) return;
  const RodScratch& s = *strand.s;
  RodState& own = *strand.own;
  for (int i = s.inside.first; i < s.inside.nodes(); ++i) {
    const bool free = c.walls[i].count == 0;
    const V3<double> force = free ? V3<double>{} : pushing_force(s, c, i), last = load3<double>(own.wall_force, i);
    const double push = std::sqrt(dot(force, force));
    if (push > 0 && dot(last, last) == 0) land(i, (1 / push) * force, s.step_s, own);
    const V3<double> rubbed = free ? V3<double>{} : rubbing_force(i, s, c);
    if (free)
      own.wall_slip.set(i, {0, 0});
    else
      take_rubbing(i, s, c, own);
    store3(own.wall_force, i, force);
    if (push == 0) continue;
    const NodeOfRod node = node_of_rod(strand, i);
    report.deepest_m = std::max(report.deepest_m, depth_in_walls(s, c, i));
    report.touches.push_back({node.rod, node.node, own.position[i] - s.inside.radius.at(0)[i] / push * to_eigen(force),
                              to_eigen(force), to_eigen(rubbed)});
  }
}

}  // namespace ostium::core
