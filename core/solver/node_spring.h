#pragma once
/// Springs between a node and the world: how everything that holds a node enters the rod's system.
#include "core/math/field.h"

namespace ostium::core {

/// Ties a node, r = target + P (internal force), to the plane n . r = place by a spring of the given compliance (m/N;
/// 0: rigid, infinite: no effect). n is a unit vector.
template <class T>
void tie(const V3<T>& n, T place, T compliance, S3<T>& P, V3<T>& target) {
  const V3<T> Pn = P * n;
  const T scale = 1.0 / (compliance + dot(n, Pn));
  const V3<T> s = scale * Pn;
  target = madd(place - dot(n, target), s, target);
  P = {nmadd(s.x, Pn.x, P.xx), nmadd(s.x, Pn.y, P.xy), nmadd(s.x, Pn.z, P.xz),
       nmadd(s.y, Pn.y, P.yy), nmadd(s.y, Pn.z, P.yz), nmadd(s.z, Pn.z, P.zz)};
}

}  // namespace ostium::core
