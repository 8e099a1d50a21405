#pragma once
/// Nested instruments: the rods of a nest share one centreline and are solved as one chain.
///
/// Where rods run inside one another they bend together, but each turns and slides on its own. The chain of a nest has
/// the elements of whichever rod is outermost, from the introducer to the most distal tip:
///
///   catheter  o-----o-----o-----o                 span 0: nodes and elements of the catheter
///   wire      - - - - - - - - - o--o----o----o    span 1: of the wire, distal to the catheter
///
/// Rods may lie side by side in one lumen. Where two of them have left it, the chain forks there (strands.cpp): the
/// trunk ends at the lumen's tip, and each branch is a nest of its own that begins at the trunk's last node.
///
/// - Within another rod a rod is a layer: it adds mass to nodes, bending to joints, and one unknown to each element:
///   its roll about the common tangent (`Roll` in solver/block_tridiagonal.h), found with everything else in one direct
///   solve. So torque reaches the tip, and a curved rod turns within a curved one, in a single step (layers.cpp).
/// - How far it has slid follows from the lengths fed. Its force on its bore, and the force on the hand, follow from
///   the balance of its moments, weight and inertia along the centreline (forces.cpp), including friction (slide.cpp).
/// - Every rod keeps its state at its own nodes and elements: the chain is assembled from them before a step and
///   returned afterwards (arrange.cpp). Nodes of an inner rod follow the centreline, moved to the side of the bore that
///   they lean on (spread.cpp).
///
/// There is no iteration between rods, and walls act on the chain as on a single rod. Neglected: within its clearance,
/// an inner rod is slightly straighter and shorter than its bore's centreline.
#include "core/model/model.h"
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// Decides which rods form a strand, alone or as a nest, and assembles the chains of nests. After feeding;
/// `was_in_body[r]`: before that.
void arrange(const Model& model, const std::vector<char>& was_in_body, State& state, Scratch& scratch);

// --- strands.cpp -----------------------------------------------------------------------------------------------------
/// Finds the strands of this step: single rods, nests, and after each nest that forks its branches.
void find_strands(const Model& model, const std::vector<char>& was_in_body, State& state, Scratch& scratch);

// --- arrange.cpp, for one nest, whose outermost rod is strand.lead ---------------------------------------------------
/// Copies the chain's state after the step back to the rods; after the commit.
void take_apart(const Nest& nest, State& state);
/// The rod, and its node, at node i of a strand.
struct NodeOfRod {
  int rod, node;
};
NodeOfRod node_of_rod(const Strand& strand, int i);
/// Distance from the introducer to the middle of a rod's element j, m; `reach_m`: where the rod leaves those around it.
double middle_of_own(const Rod& rod, const RodState& state, int j, double reach_m);

// --- spans.cpp -------------------------------------------------------------------------------------------------------
/// Lays an outer rod that has just entered the body along the rod inside it.
void lay_over(const Rod& inside, const Rod& inner, const RodState& along, RodState& state);
/// Finds where the rods of a nest leave those around them.
void find_exits(const Model& model, const State& state, const Nest& nest, Scratch& scratch);
/// Sets a nest's spans, their element lengths, and the depths of their nodes along the chain.
void lay_spans(const Model& model, Scratch& scratch, State& state, Nest& nest);

// --- cells.cpp -------------------------------------------------------------------------------------------------------
/// Sets up to which joint a rod that ends inside others contributes.
void end_inside(const Nest& nest, Layer& layer);
/// Mass, inertia, stiffness and rest curvature of all layers, cell by cell.
void lay_layers(const Model& model, const Scratch& scratch, Nest& nest);

// --- root.cpp, for a branch of a fork --------------------------------------------------------------------------------
/// Gives the trunk's last node the mass and the length of the branch's first, which is the same; after both were laid.
void weigh_root(const Nest& branch, Nest& trunk);
/// Takes over the motion of the trunk's last node; after both were gathered.
void gather_root(Nest& branch);
/// Holds its layers by the trunk's frames, as they are in the iterate.
void turn_root(Nest& branch);
/// Holds its first node where the trunk's last one goes without internal force; after the trunk was constrained.
void hold_root(Nest& branch);
/// Joins its layers to the trunk's, for solve_fork; after linearise_layers.
void join_root(Nest& branch);

// --- creep.cpp -------------------------------------------------------------------------------------------------------
/// Gives the layers' laws the creep of their rods (core/rod/relaxation.h).
void recall_layer_creep(const Model& model, const State& state, Nest& nest);

// --- layers.cpp ------------------------------------------------------------------------------------------------------
/// Predicts the inner rods' frames and turns in this step; after predict_elements.
void predict_layers(const State& state, Nest& nest);
/// Moments and stiffness of all joints of all layers: writes the chain's joints and rolls.
void linearise_layers(const State& state, Nest& nest);
/// Adds the rotary inertia of the rolls.
void add_roll_inertia(Nest& nest);
/// Applies the share `fraction` of the solution to the layers' iterates; after update_iterate.
void update_layers(double fraction, Nest& nest);
/// Largest angle of an inner joint of any layer.
double largest_layer_angle(const Nest& nest);
/// Moments and strains of the frames that are about to be committed; before that.
void measure_layers(const State& state, Nest& nest);

// --- slide.cpp -------------------------------------------------------------------------------------------------------
/// Prepares friction in bores, from the forces of the last step.
void find_slides(const Model& model, const State& state, Nest& nest);
/// Adds to the rolls the torques of friction in bores.
void turn_in_bores(Nest& nest);
/// Axial friction on node i of the chain per contact force; after the commit.
double rubbed_along(const Model& model, const Nest& nest, const Layer& layer, int i);
/// Updates the slips; after spread.
void commit_slides(const Model& model, const Nest& nest, State& state);

// --- forces.cpp ------------------------------------------------------------------------------------------------------
/// Smooths nodes 0 to last of a field over tolerances.h's length along the chain.
void smoothen(const Nest& nest, int last, Field<3>& field);
/// The chain's tangents and curvature; after the commit.
void find_centreline(Nest& nest);
/// Internal force of each layer and its force on its bore; after find_centreline.
void find_layer_forces(const Model& model, Nest& nest);
/// Force and moment of the base's hold on the rod of layer k.
void base_load(const Model& model, const Nest& nest, int k, Eigen::Vector3d& force_W_N, Eigen::Vector3d& moment_W_Nm);

// --- spread.cpp ------------------------------------------------------------------------------------------------------
/// Places the inner rods along the chain: their nodes, frames and motion; after take_apart.
void spread(const Model& model, Nest& nest, State& state);

}  // namespace ostium::core
