#include "core/step.h"

#include <algorithm>
#include <cassert>

#include "core/rod/elasticity.h"
#include "core/rod/ends.h"
#include "core/rod/inertia.h"
#include "core/rod/introducer.h"
#include "core/rod/iterate.h"
#include "core/tunables.h"

namespace ostium {

namespace {

[[maybe_unused]] bool fits(const Model& model, const Inputs& inputs, const State& state, const Scratch& scratch) {
  const std::size_t rods = model.rods.size();
  if (inputs.rods.size() != rods || state.rods.size() != rods || scratch.rods.size() != rods) return false;
  for (std::size_t r = 0; r < rods; ++r)
    if (state.rods[r].force.size() != model.rods[r].elements ||
        scratch.rods[r].chain.elements != model.rods[r].elements)
      return false;
  return true;
}

void predict(const Model& model, const Rod& rod, const RodState& state, TimeScheme scheme, RodScratch& s) {
  s.scheme = scheme;
  s.progress = Progress::open;
  s.geometric = scheme == TimeScheme::from_rest ? GeometricStiffness::without : GeometricStiffness::with;
  predict_nodes(rod, state, model.gravity_W, s.inputs.tip_force_W_N, model.step_s, s);
  hold_ends(rod, s.inputs, state, s);
  predict_elements(rod, state, s);
}

void begin(const Model& model, const Inputs& inputs, State& state, Scratch& scratch, StepReport& report) {
  report.rods.resize(model.rods.size());
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    RodScratch& s = scratch.rods[r];
    report.rods[r] = {};
    s.inputs = limited(inputs.rods[r], report.rods[r].trouble);
    const bool jump = take_hold(s.inputs, state.rods[r]);
    drive_ends(s.inputs, model.step_s, state.rods[r]);
    feed(model.rods[r], s.inputs, model.step_s, state.rods[r], report.rods[r].trouble);
    cut_at_introducer(model.rods[r], state.rods[r], s.inside);
    predict(model, s.inside, state.rods[r], jump ? TimeScheme::fresh : TimeScheme::bdf2, s);
  }
}

void linearise(const Rod& rod, const RodState& state, double step_s, RodScratch& s) {
  linearise_joints(rod, state, joints_of(s.inputs), step_s, s);
  assemble_elements(rod, s);
  add_rotary_inertia(rod, step_s, s);
  add_rotary_torque(rod, state, step_s, s);
}

/// Open rods, two at a time: a register has lanes for two.
void solve_open(Scratch& scratch) {
  RodScratch* waiting = nullptr;
  for (RodScratch& s : scratch.rods) {
    if (s.progress != Progress::open) continue;
    if (!waiting) {
      waiting = &s;
      continue;
    }
    solve(waiting->chain, &s.chain, scratch.factors);
    waiting = nullptr;
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

bool any(const Scratch& scratch, Progress progress) {
  return std::any_of(scratch.rods.begin(), scratch.rods.end(),
                     [&](const RodScratch& s) { return s.progress == progress; });
}

void iterate(const Model& model, const State& state, Scratch& scratch, StepReport& report) {
  for (int i = 0; i < tunables::max_newton_iterations && any(scratch, Progress::open); ++i) {
    for (std::size_t r = 0; r < model.rods.size(); ++r)
      if (scratch.rods[r].progress == Progress::open)
        linearise(scratch.rods[r].inside, state.rods[r], model.step_s, scratch.rods[r]);
    solve_open(scratch);
    for (std::size_t r = 0; r < model.rods.size(); ++r)
      if (scratch.rods[r].progress == Progress::open)
        take_solution(scratch.rods[r].inside, scratch.rods[r], report.rods[r]);
  }
}

bool usable(const RodScratch& s) { return s.progress != Progress::failed && s.defect <= tunables::usable_stretch; }

/// Rods that move too violently for a step give up their velocity.
void retry_from_rest(const Model& model, State& state, Scratch& scratch, StepReport& report) {
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    RodScratch& s = scratch.rods[r];
    if (usable(s)) {
      if (s.progress == Progress::open) s.progress = Progress::given_up;
      continue;
    }
    report.rods[r].trouble |= motion_lost;
    halt(s.inside, state.rods[r]);
    predict(model, s.inside, state.rods[r], TimeScheme::from_rest, s);
  }
  iterate(model, state, scratch, report);
}

void report_forces(const Model& model, const Rod& rod, const RodScratch& s, const RodState& state, RodReport& report) {
  if (s.inputs.base.hold == Hold::free) return;
  report.base_force_W_N = -state.force[rod.first] - rod.mass.at(0)[rod.first] * model.gravity_W;
  report.base_torque_W_Nm = -s.chain.joint_moment[rod.first];
  const Eigen::Vector3d along = axis(state.base);
  report.push_N = along.dot(report.base_force_W_N);
  report.torque_Nm = along.dot(report.base_torque_W_Nm);
}

void finish(const Model& model, const Rod& rod, RodScratch& s, RodState& state, RodReport& report) {
  if (s.progress == Progress::failed)
    report.trouble |= no_solution;
  else if (s.progress != Progress::done)
    report.trouble |= s.defect <= tunables::stretch_tolerance ? pulled_apart : not_converged;
  if (largest_joint_angle(rod, s) > tunables::overturned_joint_rad) report.trouble |= joint_overturned;

  // Strains and moments of the frames that are committed, not of those that were linearised about.
  if (state.strain.size() > 0)
    linearise_joints(rod, state, joints_of(s.inputs), model.step_s, s);
  else
    linearise_end_joints(rod, state, joints_of(s.inputs), model.step_s, s);
  if (usable(s))
    commit(rod, s, model.step_s, state);
  else
    commit_frames_at_rest(rod, s, state);
  follow_free_ends(rod, s.inputs, state);
  report_forces(model, rod, s, state, report);
}

}  // namespace

void step(const Model& model, const Inputs& inputs, State& state, Scratch& scratch, StepReport& report) {
  assert(fits(model, inputs, state, scratch));
  begin(model, inputs, state, scratch, report);
  iterate(model, state, scratch, report);
  if (any(scratch, Progress::open) || any(scratch, Progress::failed)) retry_from_rest(model, state, scratch, report);

  report.trouble = 0;
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    finish(model, scratch.rods[r].inside, scratch.rods[r], state.rods[r], report.rods[r]);
    report.trouble |= report.rods[r].trouble;
  }
  ++state.step;
}

}  // namespace ostium
