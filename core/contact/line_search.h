#pragma once
/// Settles ties that come and go; for contact alone.
///
/// With its rods linearised, a strand held by walls has a convex energy: quadratic, plus half k depth^2 of every plane
/// that a node is behind. A solve with given ties leads to the least of one of its quadratic pieces, which may be far
/// outside that piece; ties changed by where it leads may come and go for ever. On the way there from the best
/// point yet, the energy first falls: followed to its least on the way, which is found exactly, it falls with every
/// solve, so no set of ties returns (damped Newton's method for piecewise quadratic functions; Sun 1997, J. Optim.
/// Theory Appl. 94).
#include "core/contact/contact.h"

namespace ostium::core {

/// After a solve: where it leads, and what its ties push with there.
void look_ahead(const Strand& strand);

/// What was looked at is the best point yet: descent starts there.
void start_descent(const Strand& strand);

/// Goes from the best point, by whose ties the last solve was, towards what was looked at, as far as the energy falls.
void descend(const Strand& strand);

/// Force of the wall on a node at p if the plane is active; negative if it pulls, N.
inline double push_N(const WallPlane& w, const V3<double>& p) { return (w.place - dot(w.normal, p)) / w.softness; }

}  // namespace ostium::core
