#pragma once
/// Interpolation between neighbouring entries of a field, four places at a time; for the binding alone.
#include "core/binding/nest_scratch.h"

namespace ostium {

/// Four entries of a component, each from its own place.
template <class T>
T pick(const double* field, const int* at) {
  if constexpr (sizeof(T) == sizeof(double))
    return field[at[0]];
  else
    return T{field[at[0]], field[at[1]], field[at[2]], field[at[3]]};
}
template <class T>
V3<T> pick3(const Field<3>& f, const int* at, int shift = 0) {
  return {pick<T>(f.at(0) + shift, at), pick<T>(f.at(1) + shift, at), pick<T>(f.at(2) + shift, at)};
}
template <class T>
Q4<T> pick4(const Field<4>& f, const int* at, int shift = 0) {
  return {pick<T>(f.at(0) + shift, at), pick<T>(f.at(1) + shift, at), pick<T>(f.at(2) + shift, at),
          pick<T>(f.at(3) + shift, at)};
}
/// Beside place i.
template <class T>
V3<T> mixed3(const Field<3>& f, const Places& places, int i) {
  const int* at = places.before.data() + i;
  const V3<T> a = pick3<T>(f, at);
  return madd(load<T>(places.part.at(0) + i), pick3<T>(f, at, 1) - a, a);
}
template <class T, int K>
T mixed(const Field<K>& f, int component, const Places& places, int i) {
  const int* at = places.before.data() + i;
  const T a = pick<T>(f.at(component), at);
  return madd(load<T>(places.part.at(0) + i), pick<T>(f.at(component) + 1, at) - a, a);
}
template <class T>
Q4<T> mixed4(const Field<4>& f, const Places& places, int i) {
  const int* at = places.before.data() + i;
  const Q4<T> a = pick4<T>(f, at), b = pick4<T>(f, at, 1);
  const T cosine = madd(a.w, b.w, madd(a.x, b.x, madd(a.y, b.y, a.z * b.z)));
  const T part = load<T>(places.part.at(0) + i), sign = with_sign(part, cosine), rest = 1.0 - part;
  return normalised(Q4<T>{madd(rest, a.w, sign * b.w), madd(rest, a.x, sign * b.x), madd(rest, a.y, sign * b.y),
                          madd(rest, a.z, sign * b.z)});
}

/// q turned, by the shortest way, so that its third director becomes the unit vector d.
template <class T>
Q4<T> swung(const Q4<T>& q, const V3<T>& d) {
  const V3<T> from = director3(q), axis = cross(from, d);
  const T w = 1.0 + dot(from, d);  // almost never near 0, and then any way is as short
  return normalised(Q4<T>{largest(w, T{} + 1e-6), axis.x, axis.y, axis.z} * q);
}

}  // namespace ostium
