#include "core/step.h"

#include <algorithm>
#include <cassert>

#include "core/binding/binding.h"
#include "core/contact/contact.h"
#include "core/rod/elasticity.h"
#include "core/rod/ends.h"
#include "core/rod/inertia.h"
#include "core/rod/introducer.h"
#include "core/rod/iterate.h"
#include "core/rod/nodes.h"
#include "core/tunables.h"

namespace ostium {

namespace {

[[maybe_unused]] bool fits(const Model& model, const Inputs& inputs, const State& state, const Scratch& scratch) {
  const std::size_t rods = model.rods.size();
  if (inputs.rods.size() != rods || state.rods.size() != rods || scratch.rods.size() != rods) return false;
  for (std::size_t r = 0; r < rods; ++r)
    if (state.rods[r].force.size() != model.rods[r].elements ||
        scratch.rods[r].inside.elements != model.rods[r].elements)
      return false;
  return true;
}

/// Where nodes of rod `r` go without internal force, and how they yield to it.
void constrain(const Model& model, const State& state, std::size_t r, Scratch& scratch) {
  RodScratch& s = scratch.rods[r];
  predict_nodes(s.inside, state.rods[r], model.gravity_W, s.inputs.tip_force_W_N, s.step_s, s);
  feel_inner_rods(model, state, r, scratch);
  tie_to_bores(r, scratch);
  tie_to_walls(r, scratch);
  hold_ends(s.inside, s.inputs, state.rods[r], s);
}

void predict(const Model& model, const State& state, std::size_t r, TimeScheme scheme, Scratch& scratch) {
  RodScratch& s = scratch.rods[r];
  s.progress = s.inside.in_body() ? Progress::open : Progress::absent;
  if (s.progress == Progress::absent) return;
  s.scheme = scheme;
  s.geometric = scheme == TimeScheme::from_rest ? GeometricStiffness::without : GeometricStiffness::with;
  predict_elements(s.inside, state.rods[r], s);
  forget_corrections(scratch.bindings[r]);
  guess_nodes(state.rods[r], s);
  find_bores(model, state, r, scratch);
  expect_touches(state, r, scratch);
  find_slides(model, state, r, scratch);
  constrain(model, state, r, scratch);
  lend_to_force(state, r, scratch);
}

void begin(const Model& model, const Inputs& inputs, State& state, Scratch& scratch, StepReport& report) {
  report.rods.resize(model.rods.size());
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    RodScratch& s = scratch.rods[r];
    report.rods[r] = {};
    s.inputs = limited(inputs.rods[r], report.rods[r].trouble);
    s.step_s = model.step_s;
    s.scheme = take_hold(s.inputs, state.rods[r]) ? TimeScheme::fresh : TimeScheme::bdf2;
    drive_ends(s.inputs, model.step_s, state.rods[r]);
    feed(model.rods[r], s.inputs, model.step_s, state.rods[r], report.rods[r].trouble);
    cut_at_introducer(model.rods[r], state.rods[r], s.inside);
  }
}

void meet_walls(const Model& model, const Inputs& inputs, const State& state, Scratch& scratch) {
  move_walls(model, inputs, scratch);
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    if (!scratch.rods[r].inside.in_body()) continue;
    guess_nodes(state.rods[r], scratch.rods[r]);
    hold_enclosed(model, r, scratch);
    find_walls(model, state, r, scratch);
    expect_touches(state, r, scratch);
  }
}

void linearise(const State& state, std::size_t r, Scratch& scratch) {
  RodScratch& s = scratch.rods[r];
  const double step_s = s.step_s;
  const Rod& rod = s.inside;
  linearise_joints(rod, state.rods[r], joints_of(s.inputs), step_s, s);
  lend_to_joints(scratch.bindings[r], s);
  assemble_elements(solved_rod(scratch, r), s);
  lend_to_elements(scratch.bindings[r], s);
  add_rotary_inertia(rod, step_s, s);
  add_rotary_torque(rod, state.rods[r], step_s, s);
  turn_with_bore(r, scratch);
  take_drag(state.rods[r], s);
  turn_at_walls(r, scratch);
}

using Group = std::vector<int>;

/// Solves a rod that something holds, until its ties hold where it pushes and nowhere else.
void solve_held(const Model& model, const State& state, int r, Scratch& scratch) {
  RodScratch& s = scratch.rods[r];
  const int rims = rim_count(scratch, r);
  bool again = true;
  while (again) {
    for (int k = 0; k < rims; ++k) solve(s.chain, rim_load(r, k, scratch), scratch.factors);
    if (rims == 0) solve(s.chain, nullptr, scratch.factors);
    take_rim_loads(r, scratch);
    again = change_ties(r, scratch);
    again |= change_walls(model, state, r, scratch);
  }
}

/// Open rods of a group; those that nothing holds two at a time, as a register has lanes for two.
void solve_open(const Model& model, const State& state, const Group& group, Scratch& scratch) {
  RodScratch* waiting = nullptr;
  for (int r : group) {
    RodScratch& s = scratch.rods[r];
    if (s.progress != Progress::open) continue;
    if (is_inner(scratch, r) || !model.surfaces.empty()) {
      solve_held(model, state, r, scratch);
    } else if (!waiting) {
      waiting = &s;
    } else {
      solve(waiting->chain, &s.chain, scratch.factors);
      waiting = nullptr;
    }
  }
  if (waiting) solve(waiting->chain, nullptr, scratch.factors);
}

void take_solution(const Rod& rod, RodScratch& s, RodReport& report) {
  ++report.iterations;
  // A rod pushed beyond what it bears for a step would be solved onto the ridge between its ways of buckling.
  if (!s.chain.definite && s.geometric == GeometricStiffness::with) {
    s.geometric = GeometricStiffness::without;
    return;
  }
  const IterateChange change = update_iterate(rod, tunables::max_turn_rad, s);
  report.stretch = change.stretch;
  s.defect = change.defect;
  // The defect is quadratic in the turn of this iteration, so a small one says that the moments balance, too. A large
  // give is a rod that has not buckled yet, or cannot.
  const bool whole = change.turn_rad <= tunables::max_turn_rad;
  if (!change.finite)
    s.progress = Progress::failed;
  else if (whole && change.defect <= tunables::stretch_tolerance && change.stretch <= tunables::pulled_apart_stretch)
    s.progress = Progress::done;
}

bool any(const Group& group, const Scratch& scratch, Progress progress) {
  return std::any_of(group.begin(), group.end(), [&](int r) { return scratch.rods[r].progress == progress; });
}

void iterate(const Model& model, const State& state, const Group& group, Scratch& scratch, StepReport& report) {
  for (int i = 0; i < tunables::max_newton_iterations && any(group, scratch, Progress::open); ++i) {
    for (int r : group)
      if (scratch.rods[r].progress == Progress::open) linearise(state, r, scratch);
    solve_open(model, state, group, scratch);
    for (int r : group)
      if (scratch.rods[r].progress == Progress::open)
        take_solution(solved_rod(scratch, r), scratch.rods[r], report.rods[r]);
  }
}

bool usable(const RodScratch& s) {
  return s.progress == Progress::absent || (s.progress != Progress::failed && s.defect <= tunables::usable_stretch);
}

/// Rods that move too violently for a step give up their velocity; then, if there are walls, most of the time to move
/// in: so little moves that it can be solved, and no node has to be put anywhere.
void retry_from_rest(const Model& model, State& state, const Group& group, Scratch& scratch, StepReport& report) {
  const double shares[] = {1, 0.1, 0.01};
  for (const double share : shares) {
    if (!any(group, scratch, Progress::open) && !any(group, scratch, Progress::failed)) return;
    if (share < 1 && model.surfaces.empty()) return;
    for (int r : group) {
      RodScratch& s = scratch.rods[r];
      if (usable(s)) {
        if (s.progress == Progress::open) s.progress = Progress::given_up;
        continue;
      }
      report.rods[r].trouble |= motion_lost;
      halt(s.inside, state.rods[r]);
      s.step_s = share * model.step_s;
      predict(model, state, r, TimeScheme::from_rest, scratch);
    }
    iterate(model, state, group, scratch, report);
  }
}

void report_forces(const Model& model, const Rod& rod, const RodScratch& s, const RodState& state, RodReport& report) {
  if (s.inputs.base.hold == Hold::free) return;
  report.base_force_W_N = -state.force[rod.first] - rod.mass.at(0)[rod.first] * model.gravity_W;
  report.base_torque_W_Nm = -s.chain.joint_moment[rod.first];
  const Eigen::Vector3d along = axis(state.base);
  report.push_N = along.dot(report.base_force_W_N);
  report.torque_Nm = along.dot(report.base_torque_W_Nm);
}

void finish(const Model& model, const Rod& rod, const BindingScratch& binding, RodScratch& s, RodState& state,
            RodReport& report) {
  if (s.progress == Progress::absent) return;
  if (s.progress == Progress::failed)
    report.trouble |= no_solution;
  else if (s.progress != Progress::done)
    report.trouble |= s.defect <= tunables::stretch_tolerance ? pulled_apart : not_converged;
  if (largest_joint_angle(rod, s) > tunables::overturned_joint_rad) report.trouble |= joint_overturned;

  // Strains and moments of the frames that are committed, not of those that were linearised about.
  if (state.strain.size() > 0 || state.moment.size() > 0)
    linearise_joints(rod, state, joints_of(s.inputs), model.step_s, s);
  else
    linearise_end_joints(rod, state, joints_of(s.inputs), model.step_s, s);
  own_force(rod, binding, s, s.force);
  if (state.moment.size() > 0)
    for_packs(rod.first, rod.nodes(),
              [&]<class T>(T, int i) { store3(state.moment, i, load3<T>(s.chain.joint_moment, i)); });
  if (usable(s))
    commit(rod, s, model.step_s, state);
  else
    commit_frames_at_rest(rod, s, state);
  if (s.step_s < model.step_s) halt(rod, state);
  follow_free_ends(rod, s.inputs, state);
  report_forces(model, rod, s, state, report);
}

/// Solves outer and inner rods in turn until what the one takes for the other's force is it.
void balance_nests(const Model& model, const State& state, Scratch& scratch, StepReport& report) {
  scratch.sweeps = 1;
  measure_binding(model, scratch);
  while (true) {
    // From the inside outwards: what an outer rod is to feel is right only once its inner ones are.
    int corrected = -1;
    for (int r = static_cast<int>(model.rods.size()) - 1; r >= 0 && corrected < 0; --r) {
      RodScratch& s = scratch.rods[r];
      if (s.progress != Progress::done || !balance(r, model.step_s, state.rods[r], scratch)) continue;
      s.progress = Progress::open;
      corrected = r;
    }
    if (corrected < 0) return;
    if (scratch.sweeps == tunables::max_sweeps) {
      scratch.rods[corrected].progress = Progress::done;  // as it was before it was to be corrected again
      report.rods[corrected].trouble |= nest_unbalanced;
      return;
    }
    ++scratch.sweeps;
    for (const Group& group : scratch.groups) {
      for (int r : group) {
        RodScratch& s = scratch.rods[r];
        if (r < corrected || !is_inner(scratch, r)) continue;
        if (s.progress == Progress::failed || s.progress == Progress::absent) continue;
        move_bores(model, r, scratch);
        move_slides(model, state, r, scratch);
        constrain(model, state, r, scratch);
        s.progress = Progress::open;
      }
      iterate(model, state, group, scratch, report);
    }
    measure_binding(model, scratch);
  }
}

bool lost_in_nest(const Model& model, const Scratch& scratch, StepReport& report) {
  bool lost = false;
  for (const Nesting& n : model.nestings)
    if (is_bound(n, scratch))
      for (int r : {n.outer, n.inner})
        lost |= (report.rods[r].trouble & (motion_lost | no_solution | joint_overturned)) != 0;
  if (lost)
    for (const Nesting& n : model.nestings)
      if (is_bound(n, scratch))
        for (int r : {n.outer, n.inner}) report.rods[r].trouble |= motion_lost;
  if (lost) report.trouble |= motion_lost;
  return lost;
}

}  // namespace

void step(const Model& model, const Inputs& inputs, State& state, Scratch& scratch, StepReport& report) {
  assert(fits(model, inputs, state, scratch));
  begin(model, inputs, state, scratch, report);
  meet_walls(model, inputs, state, scratch);
  for (const Group& group : scratch.groups) {
    for (int r : group) predict(model, state, r, scratch.rods[r].scheme, scratch);
    iterate(model, state, group, scratch, report);
    retry_from_rest(model, state, group, scratch, report);
  }
  balance_nests(model, state, scratch, report);

  report.trouble = 0;
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    finish(model, scratch.rods[r].inside, scratch.bindings[r], scratch.rods[r], state.rods[r], report.rods[r]);
    report.trouble |= report.rods[r].trouble;
  }
  commit_slides(model, scratch, state);
  commit_binding(model, scratch, state);
  commit_walls(model, scratch, state, report.touches);
  if (lost_in_nest(model, scratch, report)) calm_nests(model, scratch, state);
  ++state.step;
}

}  // namespace ostium
