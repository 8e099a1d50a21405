#pragma once
/// Line search that settles ties which would otherwise keep switching. Internal to contact.
///
/// With its rods linearised, a strand in contact, with what branches off from it, has a convex energy: quadratic, plus
/// half k depth^2 for every plane that a node is behind. A solve with given ties finds the minimum of one quadratic
/// piece, which may lie far outside that piece, so ties set from it may alternate for ever. From the best point so far
/// the energy first falls in that direction. Going to the exact minimum along it lowers the energy with every solve, so
/// no set of ties returns (damped Newton's method for piecewise quadratic functions; Sun 1997, J. Optim. Theory Appl.
/// 94).
#include "core/contact/contact.h"

namespace ostium::core {

/// After a solve: stores where it leads, and the forces of its ties there.
void look_ahead(const Strand& strand);

/// Starts the line search: the stored point becomes the best point so far.
void start_descent(Tree tree);

/// Moves from the best point, whose ties the last solve used, towards the stored point as far as the energy falls.
void descend(Tree tree);

/// Force of the wall on a node at p if the plane is active, N; negative if it pulls.
inline double push_N(const WallPlane& w, const V3<double>& p) { return (w.place - dot(w.normal, p)) / w.softness; }

}  // namespace ostium::core
