#pragma once
/// A rod discretised into elements: the constant part of its mechanics.
///
///   node 0   element 0   node 1   element 1  ...   node N        base = node `first`, distal tip = node N
///     o---------------------o---------------------...o
///   joint 0               joint 1                  joint N
///
/// Nodes carry mass and position, elements a material frame, joints the bending and twisting between two elements.
/// Joint i is at node i; its cell extends from the middle of element i - 1 to the middle of element i. At the ends,
/// where the rod is joined to its hold, it is half an element.
#include "core/material/moment_law.h"
#include "core/material/section.h"

namespace ostium::core {

struct Rod {
  int elements = 0;         ///< N
  int first = 0;            ///< earlier elements are outside the introducer and inactive; N: all are
  Field<1> length;          ///< m, (#elements)
  Field<1> mass;            ///< kg, (#nodes): half of each adjacent element
  Field<2> rotary_inertia;  ///< kg m2, (#elements): about a transverse axis, about d3
  Field<1> joint_length;    ///< m, (#joints)
  Field<3> rest_curvature;  ///< 1/m, (#joints), average over the cell
  MomentLaw law;            ///< (#joints), averaged over the cell
  Field<1> bending;         ///< N m2, (#joints): the larger of EI1 and EI2, at small strain
  Field<1> radius;          ///< m, outer, (#nodes)
  Field<1> bore;            ///< m, smallest inner radius, (#elements); 0: solid
  Field<3> dead_load;       ///< N, world frame, (#nodes): static load for statics.h; empty: none
  Damping damping;
  Relaxation relaxation;
  double total_length_m = 0;  ///< of the active elements
  double total_mass_kg = 0;

  std::vector<Section> sections;        ///< as described
  std::vector<double> node_from_tip_m;  ///< (#nodes), decreasing to 0

  int nodes() const { return elements + 1; }
  bool in_body() const { return first < elements; }
};

/// Discretises a description. Properties that vary within a cell are averaged: compliance and rest curvature by their
/// integrals over the cell (so that angles add up exactly), mass by its own. Throws as `check` does, and if elements
/// are too long for the rest curvature (tolerances.h).
Rod make_rod(const RodDescription& description);

/// EI1, EI2 and GJ of a joint's cell at small strain, N m2.
Eigen::Vector3d stiffness_at_rest(const Rod& rod, int joint);

/// Makes `inside`, a copy of `whole` that may have been cut before, the part that reaches `inserted_m` back from the
/// tip: `first` becomes its first element, with the remaining length; N: none of it is inside. Changes only entries
/// near the base; does not allocate.
void cut(const Rod& whole, double inserted_m, int first, Rod& inside);

}  // namespace ostium::core
