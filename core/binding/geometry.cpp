#include "core/binding/geometry.h"

#include <algorithm>
#include <cmath>

#include "core/math/rotation.h"

namespace ostium {

namespace {
/// Curvature vector of the polygon at inner node i.
V3<double> curvature(const Rod& rod, const RodScratch& s, int i) {
  i = std::clamp(i, rod.first + 1, rod.elements - 1);
  return (1 / rod.joint_length.at(0)[i]) *
         (director3(load4<double>(s.orientation, i)) - director3(load4<double>(s.orientation, i - 1)));
}

}  // namespace

CentrelinePoint centreline(const Rod& rod, const RodScratch& s, const Field<3>& position, int element, double along) {
  const V3<double> a = load3<double>(position, element), b = load3<double>(position, element + 1);
  const double length = rod.length.at(0)[element];
  const V3<double> k = 0.5 * (curvature(rod, s, element) + curvature(rod, s, element + 1));
  CentrelinePoint out;
  out.p = madd(-0.5 * along * (1 - along) * length * length, k, madd(along, b - a, a));
  V3<double> t = madd((along - 0.5) * length * length, k, b - a);
  out.tangent = (1 / std::sqrt(dot(t, t))) * t;
  return out;
}

}  // namespace ostium
