#pragma once
/// Where things are along and across nested rods; for the binding alone.
#include <limits>

#include "core/scratch.h"

namespace ostium {

inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// Distance from the introducer to node i, along the rod.
inline double depth(const Rod& inside, int i) {
  return i == inside.first ? 0 : inside.total_length_m - inside.node_from_tip_m[i];
}

/// A point of the centreline through the nodes, smooth where the polygon has corners.
struct CentrelinePoint {
  V3<double> p, tangent;
};
/// On the element, from 0 to 1, with the frames of the iterate.
CentrelinePoint centreline(const Rod& rod, const RodScratch& s, const Field<3>& position, int element, double along);

/// What of v is across the unit vector `tangent`.
template <class T>
V3<T> across(const V3<T>& tangent, const V3<T>& v) {
  return madd(T{} - dot(tangent, v), tangent, v);
}

}  // namespace ostium
