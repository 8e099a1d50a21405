#pragma once
/// Contact of rods with moving walls.
///
/// Nodes are balls of the rod's radius. The walls that a node can reach in a step are found at the beginning of the
/// step, when it is certainly inside the lumen. Each piece of wall becomes a plane (narrow_phase.cpp) that moves with
/// the wall to the end of the step; if it came from the rim of a triangle, it is recomputed from where the node goes
/// (broad_phase.cpp). A node that would end behind a plane is tied to it by a spring as stiff as the wall; which ties
/// are active is settled within the rod's solve (active_set.cpp). After a solve, nodes that moved far are swept through
/// the triangles (continuous_collision.cpp), and walls that they crossed or touch become planes, too, so nothing passes
/// through. Friction is a spring that slips (friction.cpp), along the rod and around it, with its torque.
#include "core/model/model.h"
#include "core/model/report.h"
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// Once at the beginning of a step, or of a part of it (`from` to `to`, shares of the step): sets the walls' positions.
void move_walls(const Model& model, const Inputs& inputs, double from, double to, Scratch& scratch);

/// After move_walls: moves what lies beyond the first torn span of a nest to where that span leaves. If it would lie
/// across a wall there, it stays, and the next one is tried; gaps that remain are closed by the solve.
void move_torn_parts(const Model& model, const Strand& strand, Scratch& scratch);

/// Finds the walls that a strand can reach, from the predicted positions of its nodes.
void find_walls(const Model& model, const Strand& strand, Scratch& scratch);

/// Predicts which of them are in contact, and prepares friction.
void expect_touches(const Model& model, const Strand& strand, Scratch& scratch);

/// Ties nodes to the active walls: changes scratch.target and chain.compliance.
void tie_to_walls(const Strand& strand);

/// After a solve: releases nodes that their wall would pull, ties those behind one. True if anything changed: then the
/// chain is to be solved again; it has been updated except for ContactScratch::same elements at either end. A strand
/// with branches is settled with them; it counts for all.
bool change_walls(const Model& model, Tree tree, Scratch& scratch);

/// Once a strand has converged: where a plane presses a node deep and no wall faces it like that from where the node
/// is, finds its walls anew. Trial solutions on several sides of a ridge may have left planes that hold a node from all
/// of them. True if there are any: the strand is to be constrained and solved again.
bool find_pressing_walls_anew(const Model& model, const Strand& strand, Scratch& scratch);

/// How deep the iterate is behind walls that do not hold it, m. More than a little if the ties were not settled, or if
/// a node went round a ridge, which planes do not show.
double behind_walls(const Model& model, const Strand& strand, Scratch& scratch);

/// Adds the torque of friction; after linearise_joints and assemble_elements.
void turn_at_walls(const Strand& strand);

/// Writes forces and slips into the strand's state, appends its touches to the report and notes its depth; after the
/// commit.
void commit_walls(const Strand& strand, StepReport& report);

}  // namespace ostium::core
