#include "core/step/finish.h"

#include <algorithm>

#include "core/contact/contact.h"
#include "core/contact/rod_contact.h"
#include "core/nesting/nest.h"
#include "core/rod/elasticity.h"
#include "core/rod/ends.h"
#include "core/rod/inertia.h"
#include "core/rod/introducer.h"
#include "core/rod/iterate.h"
#include "core/rod/nodes.h"

namespace ostium::core {

namespace {

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

/// Writes the iterate into the strand's state. `solved`: it is close enough to a solution.
void finish(const State& state, const Scratch& scratch, const Strand& strand, bool solved, bool halved,
            StepReport& report) {
  RodScratch& s = *strand.s;
  const Rod& rod = s.inside;
  RodState& own = *strand.own;
  std::uint32_t& trouble = report.rods[strand.lead].trouble;
  if (s.progress == Progress::failed)
    trouble |= no_solution;
  else if (s.progress != Progress::done)
    trouble |= s.defect <= tolerances::stretch_tolerance ? pulled_apart : not_converged;
  const double angle = strand.nest ? largest_layer_angle(*strand.nest) : largest_joint_angle(rod, s);
  if (angle > tolerances::overturned_joint_rad) trouble |= joint_overturned;

  if (strand.nest && strand.nest->trunk) {
    const RodScratch& trunk = strand.nest->trunk->s;
    own.base.p_W = trunk.position[trunk.inside.elements];
    turn_root(*strand.nest);
  }
  if (!solved) string_iterate(rod, own, s);

  // Strains and moments of the committed frames, not of those that were linearised about.
  if (strand.nest)
    measure_layers(state, *strand.nest);
  else if (own.strain.size() > 0)
    linearise_joints(rod, own, joints_of(s.inputs), scratch.step_s, s);
  else
    linearise_end_joints(rod, own, joints_of(s.inputs), scratch.step_s, s);
  if (solved) {
    commit(rod, s, scratch.step_s, own);
    // A snap-through among walls, too fast for a whole step, continues from rest, part by part, heavily damped.
    if (s.step_s < scratch.step_s || halved) halt(rod, own);
    commit_walls(strand, report);
  } else {
    commit_at_rest(rod, s, own);
  }
}

/// Returns the state of a nest and its branches to their rods.
void unnest(const Model& model, Tree tree, State& state, Scratch& scratch, StepReport& report) {
  // A trunk's layers bear what they bear in the branches.
  for (std::size_t b = tree.size(); b-- > 0;) {
    find_centreline(*tree[b].nest);
    find_layer_forces(model, *tree[b].nest);
  }
  for (const Strand& strand : tree) take_apart(*strand.nest, state);
  for (const Strand& strand : tree) {
    spread(model, *strand.nest, state);
    commit_slides(model, *strand.nest, state);
  }
  const Nest& nest = *tree.front().nest;
  const RodReport whole = report.rods[tree.front().lead];
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

void finish_all(const Model& model, bool halved, State& state, Scratch& scratch, StepReport& report) {
  report.touches.clear();
  report.deepest_m = 0;
  commit_rod_contacts(scratch, report.rod_touches);
  for_trees(scratch, [&](Tree tree) {
    const bool solved = std::all_of(tree.begin(), tree.end(), [](const Strand& strand) { return usable(*strand.s); });
    for (const Strand& strand : tree) finish(state, scratch, strand, solved, halved, report);
    const Strand& strand = tree.front();
    if (strand.nest) {
      unnest(model, tree, state, scratch, report);
    } else {
      follow_free_ends(strand.s->inside, strand.s->inputs, *strand.own);
      report_forces(model, strand, report.rods[strand.lead]);
    }
  });
}

}  // namespace ostium::core
