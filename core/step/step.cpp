#include "core/step/step.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/tolerances.h"
#include "core/contact/contact.h"
#include "core/contact/rod_contact.h"
#include "core/nesting/nest.h"
#include "core/rod/elasticity.h"
#include "core/rod/ends.h"
#include "core/rod/inertia.h"
#include "core/rod/introducer.h"
#include "core/rod/iterate.h"
#include "core/rod/nodes.h"
#include "core/rod/relaxation.h"
#include "core/rod/stretch.h"
#include "core/step/finish.h"
#include "core/step/phases.h"
#include "core/step/solve.h"

namespace ostium::core {

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

/// A part of the step, as shares of it.
struct Piece {
  double from = 0, to = 1;
  int halvings = 0;

  bool is_least() const { return halvings == tolerances::max_halvings; }
  double middle() const { return (from + to) / 2; }
  Piece first_half() const { return {from, middle(), halvings + 1}; }
  Piece second_half() const { return {middle(), to, halvings + 1}; }
};

/// Applies feeding and end drives for a part of the step.
void drive_ends(const Model& model, State& state, Scratch& scratch, StepReport& report) {
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    RodScratch& s = scratch.rods[r];
    RodState& own = state.rods[r];
    s.step_s = scratch.step_s;
    scratch.was_in_body[r] = in_body(model.rods[r], own);
    renew_elements(model.rods[r], s.inputs, scratch.step_s, own);
    scratch.before_drive[r] = {own.base, own.tip, own.inserted_m, own.slack_m, own.first};
    s.scheme = take_hold(s.inputs, own) ? TimeScheme::fresh : TimeScheme::bdf2;
    drive_ends(s.inputs, scratch.step_s, own);
    feed(model.rods[r], s.inputs, scratch.step_s, own, report.rods[r].trouble);
    scratch.fed_m[r] = own.inserted_m - scratch.before_drive[r].inserted_m;
    cut_at_introducer(model.rods[r], own, s.inside);
  }
}

void take_drives_back(const Scratch& scratch, State& state) {
  for (std::size_t r = 0; r < state.rods.size(); ++r) {
    const DriveRollback& was = scratch.before_drive[r];
    RodState& own = state.rods[r];
    own.base = was.base, own.tip = was.tip;
    own.inserted_m = was.inserted_m, own.slack_m = was.slack_m, own.first = was.first;
  }
}

void recall_shapes(const Model& model, const State& state, Scratch& scratch) {
  for (const Strand& strand : scratch.strands)
    if (strand.nest)
      recall_layer_creep(model, state, *strand.nest);
    else
      recall_creep(model.rods[strand.lead], *strand.own, strand.s->inside);
}

/// Updates the creep of all rods, once per whole step.
void creep_all(const Model& model, const Scratch& scratch, State& state) {
  for (std::size_t r = 0; r < model.rods.size(); ++r)
    creep(scratch.rods[r].inside, joints_of(scratch.rods[r].inputs), model.step_s, state.rods[r]);
}

void meet_walls(const Model& model, const Inputs& inputs, Piece piece, Scratch& scratch) {
  const InPhase phase(scratch.clock, finding_walls);
  move_walls(model, inputs, piece.from, piece.to, scratch);
  for (const Strand& strand : scratch.strands) {
    if (strand.nest) move_torn_parts(model, strand, scratch);
    guess_nodes(*strand.own, *strand.s);
    find_walls(model, strand, scratch);
  }
}

/// Sets each node's position without internal force, and its compliance. A trunk's before its branches'.
void constrain(const Model& model, Scratch& scratch, const Strand& strand) {
  RodScratch& s = *strand.s;
  const auto move = [&](int rod, int begin, int end) {
    predict_nodes(s.inside, model.rods[rod].damping, begin, end, *strand.own, model.gravity_W, s.step_s, s);
    add_load(end - 1, scratch.rods[rod].inputs.tip_force_W_N, s);
    add_stretch_load(model.rods[rod], scratch.rods[rod].inputs.load, begin, end, s);
    for (const Tether& tether : scratch.rods[rod].inputs.tethers)
      tie_to_tether(model.rods[rod], tether, begin, end, *strand.own, s);
  };
  if (strand.nest)
    for (const Span& span : strand.nest->spans)
      move(span.rod, span.at > 0 ? span.at + 1 : 0, span.at + span.elements + 1);
  else
    move(strand.lead, s.inside.first, s.inside.nodes());
  tie_to_rods(strand, scratch);
  tie_to_walls(strand);
  hold_ends(s.inside, s.inputs, *strand.own, s);
  if (is_branch(strand)) hold_root(*strand.nest);
}

void predict(const Model& model, const State& state, Scratch& scratch, const Strand& strand, TimeScheme scheme) {
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
  {
    const InPhase phase(scratch.clock, changing_ties);
    expect_touches(model, strand, scratch);
  }
  constrain(model, scratch, strand);
}

void linearise(const State& state, const Strand& strand, PhaseClock* clock) {
  const InPhase phase(clock, linearising);
  RodScratch& s = *strand.s;
  if (is_branch(strand)) turn_root(*strand.nest);
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
  if (is_branch(strand)) join_root(*strand.nest);
}

bool any(const Scratch& scratch, Progress progress) {
  return std::any_of(scratch.strands.begin(), scratch.strands.end(),
                     [&](const Strand& strand) { return strand.s->progress == progress; });
}

/// What an attempt at a step is.
struct Attempt {
  bool whole = false;   ///< the step, not a part of it
  bool halves = false;  ///< without a solution, it is done again in halves
};

/// Whether a strand is far from its solution and went still farther away with the last iteration.
bool goes_astray(const Scratch& scratch) {
  return std::any_of(scratch.strands.begin(), scratch.strands.end(), [](const Strand& strand) {
    const RodScratch& s = *strand.s;
    return s.progress == Progress::open && s.defect > std::max(tolerances::astray_defect, s.last_defect);
  });
}

/// Reopens strands that have converged with a node pressed deep between walls, if looking anew may free it.
void free_pressed_nodes(const Model& model, Scratch& scratch) {
  for_trees(scratch, [&](Tree tree) {
    bool any = false;
    for (const Strand& strand : tree)
      any |= strand.s->progress == Progress::done && find_pressing_walls_anew(model, strand, scratch);
    if (!any) return;
    for (const Strand& strand : tree) {
      strand.s->progress = Progress::open;
      constrain(model, scratch, strand);
    }
  });
}

/// What does not converge is done again in halves if it can be, so no time is spent on it.
void iterate(const Model& model, const State& state, Attempt attempt, Scratch& scratch, StepReport& report) {
  const auto [whole, halves] = attempt;
  int looks = 0;
  for (int i = 0; i < tolerances::max_newton_iterations && any(scratch, Progress::open); ++i) {
    if (halves && i >= tolerances::patient_iterations && goes_astray(scratch)) return;
    for (const Strand& strand : scratch.strands)
      if (strand.s->progress == Progress::open) linearise(state, strand, scratch.clock);
    solve_open(model, scratch);
    for_trees(scratch, [&](Tree tree) {
      if (tree.front().s->progress == Progress::open)
        take_solution(tree, report.rods[tree.front().lead], scratch.counts);
    });
    if (whole && looks < tolerances::max_looks_anew && !any(scratch, Progress::open)) {
      ++looks;
      free_pressed_nodes(model, scratch);
    }
  }
}

/// Solves touching rods alternately until both feel the same force.
void settle_rod_contacts(const Model& model, const State& state, Attempt attempt, Scratch& scratch,
                         StepReport& report) {
  while (!any(scratch, Progress::failed) && renew_rod_contacts(scratch)) {
    for (const Strand& strand : scratch.strands) {
      strand.s->progress = Progress::open;
      constrain(model, scratch, strand);
    }
    iterate(model, state, attempt, scratch, report);
  }
}

/// Whether its ties to walls are settled, too.
bool settled(const Model& model, Tree tree, Scratch& scratch) {
  return std::all_of(tree.begin(), tree.end(), [&](const Strand& strand) {
    return usable(*strand.s) && behind_walls(model, strand, scratch) <= tolerances::usable_depth_m;
  });
}

bool all_done(const Model& model, Scratch& scratch) {
  return std::all_of(scratch.strands.begin(), scratch.strands.end(), [&](const Strand& strand) {
    return strand.s->progress == Progress::done && behind_walls(model, strand, scratch) <= tolerances::usable_depth_m;
  });
}

/// Strands that move too violently for a step lose their velocity; then, if there are walls, also most of the time to
/// move in, which makes the motion small enough to be solved in most cases.
void retry_from_rest(const Model& model, const State& state, Scratch& scratch, StepReport& report) {
  const double shares[] = {1, 0.1, 0.01};
  for (const double share : shares) {
    if (share < 1 && model.surfaces.empty()) return;
    bool again = false;
    for_trees(scratch, [&](Tree tree) {
      const bool is_settled = settled(model, tree, scratch);
      for (const Strand& strand : tree) {
        RodScratch& s = *strand.s;
        if (is_settled) {
          if (s.progress == Progress::open) s.progress = Progress::given_up;
          continue;
        }
        again = true;
        ++scratch.counts.retries;
        report.rods[strand.lead].trouble |= motion_lost;
        halt(s.inside, *strand.own);
        s.step_s = share * scratch.step_s;
        predict(model, state, scratch, strand, TimeScheme::from_rest);
      }
    });
    if (!again) return;
    iterate(model, state, {}, scratch, report);
  }
}

void rescale_histories(const Model& model, double ratio, State& state) {
  for (std::size_t r = 0; r < model.rods.size(); ++r)
    if (in_body(model.rods[r], state.rods[r])) rescale_history(model.rods[r], ratio, state.rods[r]);
}

/// Reserves memory for everything a step may report, so that later steps do not allocate.
void make_room(const Model& model, StepReport& report) {
  report.rods.resize(model.rods.size());
  std::size_t nodes = 0;
  for (const Rod& rod : model.rods) nodes += static_cast<std::size_t>(rod.nodes());
  report.touches.reserve(nodes);
  if (model.rods_touch) report.rod_touches.reserve(tolerances::max_rod_contacts);
}

/// Advances by a part of the step; with walls, by its halves if it has no solution as a whole.
void advance(const Model& model, const Inputs& inputs, Piece piece, State& state, Scratch& scratch,
             StepReport& report) {
  scratch.step_s = (piece.to - piece.from) * model.step_s;
  drive_ends(model, state, scratch, report);
  arrange(model, scratch.was_in_body, state, scratch);
  recall_shapes(model, state, scratch);
  meet_walls(model, inputs, piece, scratch);
  find_rod_contacts(model, scratch);
  for (const Strand& strand : scratch.strands) predict(model, state, scratch, strand, strand.s->scheme);
  const Attempt attempt{piece.halvings == 0, !model.surfaces.empty() && !piece.is_least()};
  iterate(model, state, attempt, scratch, report);
  settle_rod_contacts(model, state, attempt, scratch, report);
  if (attempt.halves && !all_done(model, scratch)) {
    ++scratch.counts.halvings;
    take_drives_back(scratch, state);
    rescale_histories(model, 0.5, state);
    advance(model, inputs, piece.first_half(), state, scratch, report);
    advance(model, inputs, piece.second_half(), state, scratch, report);
    rescale_histories(model, 2, state);
    return;
  }
  retry_from_rest(model, state, scratch, report);
  const InPhase phase(scratch.clock, finishing);
  finish_all(model, piece.halvings > 0, state, scratch, report);
}

}  // namespace

void step(const Model& model, const Inputs& inputs, State& state, Scratch& scratch, StepReport& report) {
  assert(fits(model, inputs, state, scratch));
  const InPhase phase(scratch.clock, predicting);
  make_room(model, report);
  scratch.counts = {};
  for (SurfacePose& surface : scratch.surfaces) surface.posed = 0;
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    report.rods[r] = {};
    scratch.rods[r].inputs = limited(inputs.rods[r], report.rods[r].trouble);
  }
  advance(model, inputs, {}, state, scratch, report);
  creep_all(model, scratch, state);
  for (const SurfacePose& surface : scratch.surfaces) scratch.counts.clusters += surface.posed;
  report.counts = scratch.counts;
  report.trouble = 0;
  for (const RodReport& rod : report.rods) report.trouble |= rod.trouble;
  ++state.step;
}

}  // namespace ostium::core
