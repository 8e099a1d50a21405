#pragma once
/// The binding of nested instruments: the rods of a nest share one centreline, and are solved as one chain.
///
/// Where rods run inside one another they bend together; each turns, and slides, by itself. So the chain of a nest has
/// the elements of whichever rod is the outermost, from the introducer to the tip that reaches furthest:
///
///   catheter  o-----o-----o-----o                 span 0: nodes and elements of the catheter
///   wire      - - - - - - - - - o--o----o----o    span 1: of the wire, where it has left the catheter
///
/// - Within another rod a rod is a layer: it adds its mass to nodes, its bending to joints, and one unknown to each
///   element, its roll about the common tangent (`Roll` in solve/chain.h), found with all else in one direct solve. So
///   torque goes to the tip, and a curved rod turned in a curved one, in a step (layers.cpp).
/// - How far it has slid follows from what was fed. What it exerts on its bore, and what the fingers feel, is the
///   balance of its own moments, weight and inertia along the centreline (forces.cpp), friction included (slide.cpp).
/// - Every rod has its state at its own nodes and elements: the chain is put together from them before a step, and
///   handed back after (arrange.cpp). Nodes of an inner rod follow the centreline, pressed to the side of the bore they
///   lean on (spread.cpp).
///
/// Nothing iterates between rods, and walls meet the chain as they meet a lone rod. What is left out: that an inner rod
/// is a little straighter or shorter than its bore's centreline, as far as its clearance lets it.
#include "core/model/model.h"
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// Says which rods are a strand, by themselves or as a nest, and puts the chains of nests together. After feeding;
/// `was_in_body[r]`: before that.
void arrange(const Model& model, const std::vector<char>& was_in_body, State& state, Scratch& scratch);

// --- arrange.cpp, of one nest, whose outermost rod is strand.lead
// ------------------------------------------------------
/// Hands what the step left in the chain's state back to the rods; after the commit.
void take_apart(const Nest& nest, State& state);
/// The rod and its node that node i of a strand is.
struct NodeOfRod {
  int rod, node;
};
NodeOfRod node_of_rod(const Strand& strand, int i);
/// Distance from the introducer to the middle of a rod's element j, m; `reach_m`: where it leaves the rods around it.
double middle_of_own(const Rod& rod, const RodState& state, int j, double reach_m);

// --- spans.cpp -------------------------------------------------------------------------------------------------------
/// An outer rod that has just come into the body is laid along the rod that it came over.
void lay_over(const Rod& inside, const Rod& inner, const RodState& along, RodState& state);
/// The spans of a nest: the lengths of their elements, and where their nodes are along the chain.
void lay_spans(const Model& model, Scratch& scratch, State& state, Nest& nest);

// --- cells.cpp -------------------------------------------------------------------------------------------------------
/// How far a rod has a share in joints that lies wholly inside others.
void end_inside(const Nest& nest, Layer& layer);
/// Mass, inertia, stiffness and rest curvature of all layers, cell by cell.
void lay_layers(const Model& model, const Scratch& scratch, Nest& nest);

// --- creep.cpp -------------------------------------------------------------------------------------------------------
/// Gives the layers' laws what their rods have crept by (core/rod/relaxation.h).
void recall_layer_creep(const Model& model, const State& state, Nest& nest);

// --- layers.cpp ------------------------------------------------------------------------------------------------------
/// Frames of the inner rods, and how they are expected to turn in this step; after predict_elements.
void predict_layers(const State& state, Nest& nest);
/// Moments and stiffness of all joints of all layers: writes the chain's joints and rolls.
void linearise_layers(const State& state, Nest& nest);
/// Adds the inertia of rolling.
void add_roll_inertia(Nest& nest);
/// Takes the share `fraction` of the solution into the layers' iterates; after update_iterate.
void update_layers(double fraction, Nest& nest);
/// Largest angle of an inner joint of any layer.
double largest_layer_angle(const Nest& nest);
/// Moments and strains of the frames that are to be committed; before that.
void measure_layers(const State& state, Nest& nest);

// --- slide.cpp -------------------------------------------------------------------------------------------------------
/// Prepares friction in bores, from the forces of the last step.
void find_slides(const Model& model, const State& state, Nest& nest);
/// Adds to the rolls what bores turn them with.
void turn_in_bores(Nest& nest);
/// Friction along the bore on node i of the chain, per force that presses it; after the commit.
double rubbed_along(const Model& model, const Nest& nest, const Layer& layer, int i);
/// Moves slips on; after spread.
void commit_slides(const Model& model, const Nest& nest, State& state);

// --- forces.cpp ------------------------------------------------------------------------------------------------------
/// Makes nodes 0 to last of a field smooth over tolerances.h's length along the chain.
void smoothen(const Nest& nest, int last, Field<3>& field);
/// The chain's tangents and curvature; after the commit.
void find_centreline(Nest& nest);
/// Internal force of each layer, and what it exerts on its bore; after find_centreline.
void find_layer_forces(const Model& model, Nest& nest);
/// Force and moment of what holds layer k at its base, on the rod.
void base_load(const Model& model, const Nest& nest, int k, Eigen::Vector3d& force_W_N, Eigen::Vector3d& moment_W_Nm);

// --- spread.cpp ------------------------------------------------------------------------------------------------------
/// Lays the inner rods along the chain: their nodes, frames and motion; after take_apart.
void spread(const Model& model, Nest& nest, State& state);

}  // namespace ostium::core
