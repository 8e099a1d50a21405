#include "core/step.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/binding/nest.h"
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

void begin(const Model& model, const Inputs& inputs, State& state, Scratch& scratch, StepReport& report) {
  report.rods.resize(model.rods.size());
  report.touches.clear();
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    RodScratch& s = scratch.rods[r];
    report.rods[r] = {};
    s.inputs = limited(inputs.rods[r], report.rods[r].trouble);
    s.step_s = model.step_s;
    s.scheme = take_hold(s.inputs, state.rods[r]) ? TimeScheme::fresh : TimeScheme::bdf2;
    drive_ends(s.inputs, model.step_s, state.rods[r]);
    scratch.was_in_body[r] = in_body(model.rods[r], state.rods[r]);
    scratch.fed_m[r] = -state.rods[r].inserted_m;
    feed(model.rods[r], s.inputs, model.step_s, state.rods[r], report.rods[r].trouble);
    scratch.fed_m[r] += state.rods[r].inserted_m;
    cut_at_introducer(model.rods[r], state.rods[r], s.inside);
  }
}

void meet_walls(const Model& model, const Inputs& inputs, Scratch& scratch) {
  move_walls(model, inputs, scratch);
  for (const Strand& strand : scratch.strands) {
    guess_nodes(*strand.own, *strand.s);
    find_walls(model, strand, scratch);
  }
}

/// Spreads a rod's load over those of the chain's nodes [begin, end) that are its own, the last of which is its tip.
void add_stretch_load(const Rod& rod, const StretchLoad& load, int begin, int end, RodScratch& s) {
  if (load.force_W_N.isZero()) return;
  const auto from_tip_m = [&](int i) { return rod.node_from_tip_m[rod.elements - (end - 1 - i)]; };
  const double middle_m = (load.from_tip_m + load.to_tip_m) / 2;
  int first = end, last = begin - 1, nearest = end - 1;
  for (int i = begin; i < end; ++i) {
    if (std::fabs(from_tip_m(i) - middle_m) < std::fabs(from_tip_m(nearest) - middle_m)) nearest = i;
    if (from_tip_m(i) < load.from_tip_m || from_tip_m(i) > load.to_tip_m) continue;
    first = std::min(first, i), last = i;
  }
  if (last < first) first = last = nearest;
  for (int i = first; i <= last; ++i) add_load(i, load.force_W_N / (last - first + 1), s);
}

/// Where nodes go without internal force, and how they yield to it.
void constrain(const Model& model, const Scratch& scratch, const Strand& strand) {
  RodScratch& s = *strand.s;
  const auto move = [&](int rod, int begin, int end) {
    predict_nodes(s.inside, model.rods[rod].damping, begin, end, *strand.own, model.gravity_W, s.step_s, s);
    add_load(end - 1, scratch.rods[rod].inputs.tip_force_W_N, s);
    add_stretch_load(model.rods[rod], scratch.rods[rod].inputs.load, begin, end, s);
  };
  if (strand.nest)
    for (const Span& span : strand.nest->spans)
      move(span.rod, span.at > 0 ? span.at + 1 : 0, span.at + span.elements + 1);
  else
    move(strand.lead, s.inside.first, s.inside.nodes());
  tie_to_walls(strand);
  hold_ends(s.inside, s.inputs, *strand.own, s);
}

void predict(const Model& model, const State& state, const Scratch& scratch, const Strand& strand, TimeScheme scheme) {
  RodScratch& s = *strand.s;
  s.progress = Progress::open;
  s.scheme = scheme;
  s.geometric = scheme == TimeScheme::from_rest ? GeometricStiffness::without : GeometricStiffness::with;
  predict_elements(s.inside, *strand.own, s);
  if (strand.nest) {
    predict_layers(state, *strand.nest);
    find_slides(model, state, *strand.nest);
  }
  guess_nodes(*strand.own, s);
  expect_touches(strand);
  constrain(model, scratch, strand);
}

void linearise(const State& state, const Strand& strand) {
  RodScratch& s = *strand.s;
  if (strand.nest)
    linearise_layers(state, *strand.nest);
  else
    linearise_joints(s.inside, *strand.own, joints_of(s.inputs), s.step_s, s);
  assemble_elements(s.inside, s);
  add_rotary_inertia(s.inside, s.step_s, s);
  add_rotary_torque(s.inside, *strand.own, s.step_s, s);
  if (strand.nest) {
    add_roll_inertia(*strand.nest);
    turn_in_bores(*strand.nest);
  }
  turn_at_walls(strand);
}

/// Whether the solution is near enough to be taken as it is, and to tell by it which walls are touched.
bool is_near(const RodScratch& s) {
  return s.chain.definite && largest_turn(s.inside, s.chain) <= tunables::max_turn_rad;
}

/// Solves a strand that walls hold, until its ties hold where it pushes and nowhere else.
void solve_held(const Model& model, const Strand& strand, Scratch& scratch) {
  do solve(strand.s->chain, nullptr, scratch.factors);
  while (is_near(*strand.s) && change_walls(model, strand, scratch));
}

/// Strands that are open; lone rods in the open two at a time, as a register has lanes for two.
void solve_open(const Model& model, Scratch& scratch) {
  RodScratch* waiting = nullptr;
  for (const Strand& strand : scratch.strands) {
    RodScratch& s = *strand.s;
    if (s.progress != Progress::open) continue;
    if (strand.nest || !model.surfaces.empty()) {
      solve_held(model, strand, scratch);
    } else if (!waiting) {
      waiting = &s;
    } else {
      solve(waiting->chain, &s.chain, scratch.factors);
      waiting = nullptr;
    }
  }
  if (waiting) solve(waiting->chain, nullptr, scratch.factors);
}

void take_solution(const Strand& strand, RodReport& report) {
  RodScratch& s = *strand.s;
  ++report.iterations;
  // A rod pushed beyond what it bears for a step would be solved onto the ridge between its ways of buckling.
  if (!s.chain.definite && s.geometric == GeometricStiffness::with) {
    s.geometric = GeometricStiffness::without;
    return;
  }
  const IterateChange change = update_iterate(s.inside, tunables::max_turn_rad, s);
  if (strand.nest && change.finite) update_layers(change.fraction, *strand.nest);
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
  return std::any_of(scratch.strands.begin(), scratch.strands.end(),
                     [&](const Strand& strand) { return strand.s->progress == progress; });
}

void iterate(const Model& model, const State& state, Scratch& scratch, StepReport& report) {
  for (int i = 0; i < tunables::max_newton_iterations && any(scratch, Progress::open); ++i) {
    for (const Strand& strand : scratch.strands)
      if (strand.s->progress == Progress::open) linearise(state, strand);
    solve_open(model, scratch);
    for (const Strand& strand : scratch.strands)
      if (strand.s->progress == Progress::open) take_solution(strand, report.rods[strand.lead]);
  }
}

bool usable(const RodScratch& s) { return s.progress != Progress::failed && s.defect <= tunables::usable_stretch; }

/// Whether its ties to walls are settled, too.
bool settled(const Strand& strand) { return usable(*strand.s) && behind_walls(strand) <= tunables::usable_depth_m; }

/// Strands whose ties did not settle from the fewest that may hold them are tried from the most.
void retry_warily(const Model& model, const State& state, Scratch& scratch, StepReport& report) {
  bool again = false;
  for (const Strand& strand : scratch.strands) {
    if (strand.contact->walls.empty()) continue;
    if (strand.s->progress == Progress::done && settled(strand) && !gave_up_releasing(strand)) continue;
    again = strand.contact->wary = true;
    predict(model, state, scratch, strand, strand.s->scheme);
  }
  if (again) iterate(model, state, scratch, report);
}

/// Strands that move too violently for a step give up their velocity; then, if there are walls, most of the time to
/// move in: so little moves that it can mostly be solved.
void retry_from_rest(const Model& model, const State& state, Scratch& scratch, StepReport& report) {
  const double shares[] = {1, 0.1, 0.01};
  for (const double share : shares) {
    if (share < 1 && model.surfaces.empty()) return;
    bool again = false;
    for (const Strand& strand : scratch.strands) {
      RodScratch& s = *strand.s;
      if (settled(strand)) {
        if (s.progress == Progress::open) s.progress = Progress::given_up;
        continue;
      }
      again = true;
      report.rods[strand.lead].trouble |= motion_lost;
      halt(s.inside, *strand.own);
      s.step_s = share * model.step_s;
      predict(model, state, scratch, strand, TimeScheme::from_rest);
    }
    if (!again) return;
    iterate(model, state, scratch, report);
  }
}

void report_base(const EndState& base, const Eigen::Vector3d& force_W_N, const Eigen::Vector3d& torque_W_Nm,
                 RodReport& report) {
  report.base_force_W_N = force_W_N;
  report.base_torque_W_Nm = torque_W_Nm;
  const Eigen::Vector3d along = axis(base);
  report.push_N = along.dot(force_W_N);
  report.torque_Nm = along.dot(torque_W_Nm);
}

void report_forces(const Model& model, const Strand& strand, RodReport& report) {
  const RodScratch& s = *strand.s;
  if (s.inputs.base.hold == Hold::free) return;
  const int first = s.inside.first;
  report_base(strand.own->base, -strand.own->force[first] - s.inside.mass.at(0)[first] * model.gravity_W,
              -s.chain.joint_moment[first], report);
}

/// The iterate becomes the strand's state.
void finish(const Model& model, const State& state, const Strand& strand, StepReport& report) {
  RodScratch& s = *strand.s;
  const Rod& rod = s.inside;
  RodState& own = *strand.own;
  std::uint32_t& trouble = report.rods[strand.lead].trouble;
  if (s.progress == Progress::failed)
    trouble |= no_solution;
  else if (s.progress != Progress::done)
    trouble |= s.defect <= tunables::stretch_tolerance ? pulled_apart : not_converged;
  const double angle = strand.nest ? largest_layer_angle(*strand.nest) : largest_joint_angle(rod, s);
  if (angle > tunables::overturned_joint_rad) trouble |= joint_overturned;

  const bool solved = usable(s);
  if (!solved) string_iterate(rod, own, s);

  // Strains and moments of the frames that are committed, not of those that were linearised about.
  if (strand.nest)
    measure_layers(state, *strand.nest);
  else if (own.strain.size() > 0)
    linearise_joints(rod, own, joints_of(s.inputs), model.step_s, s);
  else
    linearise_end_joints(rod, own, joints_of(s.inputs), model.step_s, s);
  if (solved) {
    commit(rod, s, model.step_s, own);
    if (s.step_s < model.step_s) halt(rod, own);
    commit_walls(model, strand, report.touches);
  } else {
    commit_at_rest(rod, s, own);
  }
}

/// A nest's state goes back to its rods.
void unnest(const Model& model, const Strand& strand, State& state, Scratch& scratch, StepReport& report) {
  Nest& nest = *strand.nest;
  find_centreline(nest);
  find_layer_forces(model, nest);
  take_apart(nest, state);
  spread(model, nest, state);
  commit_slides(model, nest, state);
  const RodReport whole = report.rods[strand.lead];
  for (int k = 0; k < nest.layer_count; ++k) {
    const int r = nest.layers[k].rod;
    RodReport& own = report.rods[r];
    own.iterations = whole.iterations, own.stretch = whole.stretch;
    own.trouble |=
        whole.trouble & ~static_cast<std::uint32_t>(feed_stopped | drive_limited | drive_not_finite | load_limited);
    follow_free_ends(scratch.rods[r].inside, scratch.rods[r].inputs, state.rods[r]);
    Eigen::Vector3d force_W_N, torque_W_Nm;
    base_load(model, nest, k, force_W_N, torque_W_Nm);
    report_base(state.rods[r].base, force_W_N, torque_W_Nm, own);
  }
}

}  // namespace

void step(const Model& model, const Inputs& inputs, State& state, Scratch& scratch, StepReport& report) {
  assert(fits(model, inputs, state, scratch));
  begin(model, inputs, state, scratch, report);
  arrange(model, scratch.was_in_body, state, scratch);
  meet_walls(model, inputs, scratch);
  for (const Strand& strand : scratch.strands) predict(model, state, scratch, strand, strand.s->scheme);
  iterate(model, state, scratch, report);
  retry_warily(model, state, scratch, report);
  retry_from_rest(model, state, scratch, report);

  for (const Strand& strand : scratch.strands) {
    finish(model, state, strand, report);
    if (strand.nest) {
      unnest(model, strand, state, scratch, report);
    } else {
      follow_free_ends(strand.s->inside, strand.s->inputs, *strand.own);
      report_forces(model, strand, report.rods[strand.lead]);
    }
  }
  report.trouble = 0;
  for (const RodReport& rod : report.rods) report.trouble |= rod.trouble;
  ++state.step;
}

}  // namespace ostium
