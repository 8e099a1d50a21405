#include "core/step.h"

#include <algorithm>
#include <cassert>

#include "core/rod/elasticity.h"
#include "core/rod/ends.h"
#include "core/rod/inertia.h"
#include "core/rod/iterate.h"
#include "core/tunables.h"

namespace ostium {

namespace {

bool fits(const Model& model, const Inputs& inputs, const State& state, const Scratch& scratch) {
  const std::size_t rods = model.rods.size();
  if (inputs.rods.size() != rods || state.rods.size() != rods || scratch.rods.size() != rods) return false;
  for (std::size_t r = 0; r < rods; ++r)
    if (state.rods[r].force.size() != model.rods[r].elements || scratch.rods[r].chain.elements != model.rods[r].elements)
      return false;
  return true;
}

void begin(const Model& model, const Inputs& inputs, State& state, Scratch& scratch, StepReport& report) {
  report.rods.resize(model.rods.size());
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    const Rod& rod = model.rods[r];
    RodScratch& s = scratch.rods[r];
    report.rods[r] = {};
    s.inputs = limited(inputs.rods[r], report.rods[r].trouble);
    s.fresh = take_hold(s.inputs, state.rods[r]);
    drive_ends(s.inputs, model.step_s, state.rods[r]);
    predict_nodes(rod, state.rods[r], model.gravity_W, s.inputs.tip_force_W_N, model.step_s, s);
    hold_ends(rod, s.inputs, state.rods[r], s);
    predict_elements(rod, state.rods[r], s);
    s.done = false;
  }
}

void linearise(const Rod& rod, const RodState& state, double step_s, RodScratch& s) {
  linearise_joints(rod, state, joints_of(s.inputs), step_s, s);
  assemble_elements(rod, s);
  add_rotary_inertia(rod, step_s, s);
  add_rotary_torque(rod, state, step_s, s);
}

/// Rods that are not done yet, two at a time: a register has lanes for two.
void solve_open(Scratch& scratch) {
  RodScratch* waiting = nullptr;
  for (RodScratch& s : scratch.rods) {
    if (s.done) continue;
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
  const IterateChange change = update_iterate(rod, tunables::max_turn_rad, s);
  ++report.iterations;
  if (!change.finite) report.trouble |= solve_failed;
  else report.stretch = change.stretch;
  s.done = !change.finite || change.stretch <= tunables::stretch_tolerance;
}

void finish(const Rod& rod, const Model& model, const RodScratch& s, RodState& state, RodReport& report) {
  if (!s.done) report.trouble |= not_converged;
  if (report.trouble & solve_failed)
    halt(rod, state);
  else
    commit(rod, s, model.step_s, state);
  follow_free_ends(rod, s.inputs, state);
  report.base_force_W_N = -state.force[0] - rod.mass.at(0)[0] * model.gravity_W;
  report.base_torque_W_Nm = -s.chain.joint_moment[0];
}

}  // namespace

Scratch::Scratch(const Model& model) {
  int longest = 0;
  for (const Rod& rod : model.rods) {
    const int N = rod.elements;
    longest = std::max(longest, N);
    RodScratch& s = rods.emplace_back();
    s.chain = Chain(N);
    s.target.resize(N + 1);
    s.position.resize(N + 1);
    s.orientation.resize(N);
    s.turn.resize(N);
    s.force.resize(N);
    if (rod.damping.material_time_s > 0) s.strain.resize(N + 1);
  }
  factors.resize(chain_blocks(longest));
}

void step(const Model& model, const Inputs& inputs, State& state, Scratch& scratch, StepReport& report) {
  assert(fits(model, inputs, state, scratch));
  begin(model, inputs, state, scratch, report);
  for (int iteration = 0; iteration < tunables::max_newton_iterations; ++iteration) {
    for (std::size_t r = 0; r < model.rods.size(); ++r)
      if (!scratch.rods[r].done) linearise(model.rods[r], state.rods[r], model.step_s, scratch.rods[r]);
    solve_open(scratch);
    bool done = true;
    for (std::size_t r = 0; r < model.rods.size(); ++r) {
      if (!scratch.rods[r].done) take_solution(model.rods[r], scratch.rods[r], report.rods[r]);
      done = done && scratch.rods[r].done;
    }
    if (done) break;
  }
  report.trouble = 0;
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    finish(model.rods[r], model, scratch.rods[r], state.rods[r], report.rods[r]);
    report.trouble |= report.rods[r].trouble;
  }
  ++state.step;
}

}  // namespace ostium
