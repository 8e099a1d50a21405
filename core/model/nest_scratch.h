#pragma once
/// Working memory of the binding: one nest.
#include <vector>

#include "core/model/contact_scratch.h"
#include "core/model/nesting.h"
#include "core/model/rod_scratch.h"

namespace ostium::core {

/// Most rods of a nest.
inline constexpr int max_layers = max_outer_rods + 1;

/// A stretch of a nest's chain that has the elements of one rod, the outermost there.
struct Span {
  int rod = 0;
  int first = 0;     ///< its element that the span begins with: what of it protrudes, if another span is before
  int at = 0;        ///< element of the chain that this is
  int elements = 0;  ///< to the rod's tip
};

/// Which entries of a field lie beside a place, and how: f = (1 - part) f[before] + part f[before + 1].
struct Places {
  std::vector<int> before;
  Field<1> part;

  void resize(int size) { before.resize(size), part.resize(size); }
};

/// A rod as part of a nest's chain. Fields are over the chain's elements, nodes or joints.
struct Layer {
  int rod = 0;
  int covered = 0;         ///< elements 0 to covered - 1 are (in part) inside other rods
  int end = 0;             ///< elements covered to end - 1 are its own span, if it has one: then end > covered
  int roll = -1;           ///< of the chain, for the turn about d3 against the chain's frames; -1: the outermost rod
  double inserted_m = 0;   ///< length of it from the introducer
  double damping_s = 0;    ///< Kelvin-Voigt
  double viscous = 0;      ///< damping_s over the step
  Field<1> length;         ///< m, own element lengths, with what the introducer and the span's beginning make of them
  MomentLaw law;           ///< (#joints), and
  Field<3> rest;           ///< 1/m, (#joints)
  Field<1> mass;           ///< kg, (#nodes)
  Field<1> polar;          ///< kg m2, rotary inertia about d3, (#elements)
  Places from_own;         ///< own elements beside the middle of an element, (#elements covered)
  Field<4> orientation;    ///< iterate, (#elements)
  Field<3> turn;           ///< rad, iterate since the beginning of the step, (#elements)
  Field<1> spin_before;    ///< rad, about d3 in the last step, (#elements covered)
  V3<double> base_turn;    ///< rad, of its hold at the introducer in this step
  Field<3> moment;         ///< N m, (#joints), at the end of the step
  Field<3> before, after;  ///< N m/rad, (#joints): what a roll of the element before, behind asks of the turns, and
  Field<4> rolling;        ///< of itself, and the torques on them: before, behind, before, behind
  Places to_nodes;         ///< chain elements that the rod's nodes are on, (#nodes of the rod that are not exposed)
  Places to_elements;      ///< chain elements beside the middles of the rod's, the same
  // --- in its bore
  std::vector<int> host;  ///< layer around it whose lumen holds it, (#elements covered)
  Field<1> room;          ///< m, clearance there
  double fed_m = 0;       ///< length that was pushed in in this step
  bool slides = false;    ///< with friction
  Field<3> force;         ///< N, (#elements covered), internal, at the end of the step
  Field<3> press;         ///< N, (#nodes), of the bore on it
  Field<1> along;         ///< N, (#nodes): its balance along the bore, but for tension
  Field<1> lever, gain;   ///< (#nodes): how tension behind a node, and what is along it, make the tension before it
  Field<1> tension;       ///< N, (#elements covered, and beyond)
  Field<2> slip;          ///< m, (#nodes), at the beginning of the step: along, around
  Field<1> grip;          ///< N m/rad, (#elements), of friction against turning, and
  Field<1> drag;          ///< N m, the same at the beginning of the step
  Field<3> lean;          ///< m, (#nodes), where its bore's clearance lets it lie
};

/// How a layer lay in the chain when its cells were cut.
struct Laid {
  int rod = -1, first = 0, exposed = 0;
  double inserted_m = 0;
  bool operator==(const Laid&) const = default;
};

struct Nest {
  std::vector<int> members;  ///< outermost first; a nest if there is more than one
  std::vector<Span> spans;
  int layer_count = 0;
  std::vector<Layer> layers;  ///< as members
  Laid laid[max_layers];
  bool moved = true;  ///< the rods do not lie against each other as they did: places and cells are new
  double step_s = 0;
  RodScratch s;  ///< of the chain
  RodState own;  ///< the chain's, between arrange and take_apart
  ContactScratch contact;
  Field<1> depth;     ///< m, (#nodes): from the introducer along the chain
  Field<1> nearness;  ///< (#elements): how much of a node's own a smooth field keeps beside its neighbour, see smoothen
  Field<3> tangent;   ///< (#nodes), unit, and
  Field<3> bend;      ///< 1/m, (#nodes), curvature vector: of the committed chain
};

/// What is solved as one: a lone rod, or a nest.
struct Strand {
  int lead = 0;  ///< its (outermost) rod
  RodScratch* s = nullptr;
  RodState* own = nullptr;
  ContactScratch* contact = nullptr;
  Nest* nest = nullptr;  ///< null: a lone rod
};

}  // namespace ostium::core
