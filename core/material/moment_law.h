#pragma once
/// The moment-curvature laws of a rod: the moment of a joint's cell as a function of its strain.
///
/// A law is a plain struct in a header of its own, with its parameters per joint and
///   `template <class T> MomentResponse<T> operator()(const V3<T>& strain, int joint) const;`
///   double energy(const V3<double>& strain, int joint) const;                              // per length, J/m
///   void set_cell(int joint, double length_m, const Eigen::Vector3d& compliance, const BendingIntegrals&);
///       // when a rod is cut
///   void resize(int joints);   void copy(const Law&, int from, int to, int joint);         // when rods are nested
/// where `strain` = u - u_rest (1/m, material axes d1, d2, d3) and T is double or four neighbouring joints in SIMD
/// lanes. To add a law: its header, its name in the list below, the line of rod.cpp that chooses it, and a test.
#include <variant>

#include "core/material/relaxing.h"

namespace ostium::core {

using MomentLaw = std::variant<LinearElastic, Superelastic, Tabulated, Relaxing>;

/// The curve's knots of a law that has one; null: it has none.
template <class Law>
auto* curve_knots(Law& law) {
  auto* tabulated = std::get_if<Tabulated>(&law);
  auto* relaxing = std::get_if<Relaxing>(&law);
  return tabulated ? &tabulated->knots : relaxing ? &relaxing->at_once.knots : nullptr;
}

}  // namespace ostium::core
