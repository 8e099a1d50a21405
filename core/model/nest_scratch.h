#pragma once
/// Working memory of one nest (nested rods).
#include <span>
#include <vector>

#include "core/model/contact_scratch.h"
#include "core/model/nesting.h"
#include "core/model/rod_scratch.h"
#include "core/solver/fork.h"

namespace ostium::core {

/// Largest number of rods in a nest: two rods side by side, each with one around it, in a guide.
inline constexpr int max_layers = 5;

/// A stretch of a nest's chain made of the elements of one rod, the outermost there.
struct Span {
  int rod = 0;
  int first = 0;      ///< first element of the rod in the span; behind another span, only its protruding part
  int at = 0;         ///< index of that element in the chain
  int elements = 0;   ///< to the rod's tip
  bool torn = false;  ///< from where it leaves: it and what lies beyond are to be moved there
};

/// Where a rod leaves those around it.
struct Exit {
  int first = 0;       ///< its first element outside of them; N: none
  double depth_m = 0;  ///< distance of that place from the introducer
  int from = 0;        ///< the rod whose tip is there
  bool torn = false;   ///< as in Span
};

/// For each position, the field entries around it and the weight: f = (1 - part) f[before] + part f[before + 1].
struct Places {
  std::vector<int> before;
  Field<1> part;

  void resize(int size) { before.resize(size), part.resize(size); }
};

/// A rod as part of a nest's chain. Fields are over the chain's elements, nodes or joints.
struct Layer {
  int rod = 0;
  int covered = 0;              ///< elements 0 to covered - 1 are (partly) inside other rods
  int end = 0;                  ///< elements covered to end - 1 are its own span if end > covered; 0: it has none
  int roll = -1;                ///< index of its roll in the chain, about d3; -1: the outermost rod
  double inserted_m = 0;        ///< length from the introducer
  double damping_s = 0;         ///< Kelvin-Voigt
  double viscous = 0;           ///< damping_s over the step
  Field<1> length;              ///< m, own element lengths, shortened at the introducer and at the start of the span
  MomentLaw law;                ///< (#joints), and
  Field<3> rest;                ///< 1/m, (#joints)
  Field<1> mass;                ///< kg, (#nodes)
  Field<1> polar;               ///< kg m2, rotary inertia about d3, (#elements)
  Places from_own;              ///< own elements around the middle of each chain element, (#elements covered)
  Field<4> orientation;         ///< iterate, (#elements)
  Field<3> turn;                ///< rad, iterate since the beginning of the step, (#elements)
  Field<1> spin_before;         ///< rad, about d3 in the last step, (#elements covered)
  Q4<double> base_frame{};      ///< material frame that holds its base: at the introducer, or on the trunk, and
  V3<double> base_turn{};       ///< rad, how that turned in this step
  S3<double> base_stiffness{};  ///< N m/rad, of the joint to it, and
  V3<double> base_moment{};     ///< N m, its moment
  Field<3> moment;              ///< N m, (#joints), at the end of the step
  Field<3> before, after;       ///< N m/rad, (#joints): coupling of a roll of the element before or behind to the turns
  Field<4> rolling;             ///< its diagonal and torques: before, behind, before, behind
  Places to_nodes;              ///< chain elements around the rod's nodes, (#nodes of the rod that are not exposed)
  Places to_elements;           ///< chain elements around the middles of the rod's elements, likewise
  // --- the rod's nodes and elements that lie along the chain
  int first_node = 0, end_node = 0;
  int first_element = 0, end_element = 0;
  // --- in its bore
  std::vector<int> host;  ///< layer whose lumen holds it, (#elements covered)
  Field<1> room;          ///< m, clearance there
  double fed_m = 0;       ///< length pushed in during this step
  bool slides = false;    ///< has friction
  Field<3> force;         ///< N, (#elements covered), internal, at the end of the step
  Field<3> press;         ///< N, (#nodes), of the bore on the rod
  Field<1> along;         ///< N, (#nodes): force balance along the bore without tension
  Field<1> lever, gain;   ///< (#nodes): how tension after a node, and `along`, give the tension before it
  Field<1> tension;       ///< N, (#elements covered, and beyond)
  Field<2> slip;          ///< m, (#nodes), at the beginning of the step: along, around
  Field<1> grip;          ///< N m/rad, (#elements), stiffness of friction against turning
  Field<1> drag;          ///< N m, its torque at the beginning of the step
  Field<3> lean;          ///< m, (#nodes), sideways position within the bore's clearance
};

/// Arrangement of a layer in the chain when its cells were computed.
struct Laid {
  int rod = -1, first = 0, exposed = 0;
  double inserted_m = 0;
  double fork_m = 0;  ///< where the nest begins
  bool operator==(const Laid&) const = default;
};

struct Nest {
  std::vector<int> members;      ///< outermost first; it is a nest if there are several
  Nest* trunk = nullptr;         ///< where it is a branch of a fork: the nest at whose tip it begins, and
  int beside[max_layers];        ///< its layers' layers there
  double fork_m = 0;             ///< m, from the introducer: its first node; 0 without a trunk
  double behind_m = 0;           ///< m, length of the trunk's last element
  Nest* branches[max_branches];  ///< that begin at its tip
  int branch_count = 0;
  ForkBranch fork;             ///< as such a branch: its part of the linear system
  TridiagonalFactors factors;  ///< likewise
  std::vector<Span> spans;
  int layer_count = 0;
  std::vector<Layer> layers;  ///< in the order of members
  Laid laid[max_layers];
  bool moved = true;  ///< the rods' arrangement changed: interpolation and cells are recomputed
  double step_s = 0;
  RodScratch s;  ///< of the chain
  RodState own;  ///< the chain's state, between arrange and take_apart
  ContactScratch contact;
  Field<1> depth;     ///< m, (#nodes): distance from the introducer along the chain
  Field<1> nearness;  ///< (#elements): weight of a node's own value against its neighbour's in smoothen
  Field<3> tangent;   ///< (#nodes), unit, of the committed chain
  Field<3> bend;      ///< 1/m, (#nodes), curvature vector of it
};

/// What is solved as one system: a single rod or a nest.
struct Strand {
  int lead = 0;  ///< its outermost rod
  RodScratch* s = nullptr;
  RodState* own = nullptr;
  ContactScratch* contact = nullptr;
  Nest* nest = nullptr;  ///< null: a single rod
  int branches = 0;      ///< the next strands that begin at its tip and are solved with it
};

/// A strand with the branches that hang on it.
using Tree = std::span<const Strand>;

}  // namespace ostium::core
