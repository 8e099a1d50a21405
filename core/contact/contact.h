#pragma once
/// Contact of rods with walls that move.
///
/// Nodes are balls of the rod's radius. What of a wall a node can reach in a step is found at the beginning of the
/// step, when the node is inside the lumen for certain: each piece of wall becomes a plane there (narrow_phase.cpp),
/// which the wall carries to the end of the step, and which is seen anew from where the node goes, if it was the rim of
/// a triangle (broad_phase.cpp). A node that would end behind a plane is tied to it, a spring as stiff as the wall; an
/// active set, settled within the rod's solve (active_set.cpp). After a solve the path of nodes that went far is
/// followed through the triangles (continuous_collision.cpp), and walls that they passed or meet there are planes, too:
/// nothing gets through. Friction is a spring that slips (friction.cpp): along the rod and around it, with its torque.
#include "core/model/model.h"
#include "core/model/report.h"
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// At the beginning of a step, once: where the walls are; of a piece of it, which goes from one part of it to another.
void move_walls(const Model& model, const Inputs& inputs, double from, double to, Scratch& scratch);

/// Finds the walls that a strand can reach, from its guess of the iterate.
void find_walls(const Model& model, const Strand& strand, Scratch& scratch);

/// Says which of them it is expected to touch, and prepares friction.
void expect_touches(const Model& model, const Strand& strand, Scratch& scratch);

/// Ties nodes to these: changes scratch.target and chain.compliance.
void tie_to_walls(const Strand& strand);

/// After a solve: lets nodes go that their wall would pull, ties those that are behind one. True if there are any: then
/// the chain, which is adapted but for ContactScratch::same elements at either end, is to be solved again.
bool change_walls(const Model& model, const Strand& strand, Scratch& scratch);

/// How far the iterate is behind walls that do not hold it, m: more than little if the ties were not settled, or if a
/// node went round a ridge that planes cannot tell of.
double behind_walls(const Model& model, const Strand& strand, Scratch& scratch);

/// Adds the torque of friction; after linearise_joints and assemble_elements.
void turn_at_walls(const Strand& strand);

/// Moves forces and slips into the strand's state, and adds its touches; after the commit.
void commit_walls(const Strand& strand, std::vector<Touch>& touches);

}  // namespace ostium::core
