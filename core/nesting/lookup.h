#pragma once
/// Interpolation between neighbouring entries of a field, four positions at a time. Internal to core/nesting.
#include "core/model/nest_scratch.h"

namespace ostium::core {

/// Index at which to interpolate, for a pack of four positions or one.
struct Spot {
  const int* at;
  bool row;  ///< four consecutive entries, as almost always: one load, since a gather costs seven times as much

  Spot(const Places& places, int i, Lanes) : at(places.before.data() + i) {
    row = at[1] == at[0] + 1 && at[2] == at[0] + 2 && at[3] == at[0] + 3;
  }
  Spot(const Places& places, int i, double) : at(places.before.data() + i), row(true) {}
};

template <class T>
T pick(const double* field, const Spot& spot) {
  if constexpr (sizeof(T) == sizeof(double))
    return field[spot.at[0]];
  else
    return spot.row ? load<T>(field + spot.at[0])
                    : T{field[spot.at[0]], field[spot.at[1]], field[spot.at[2]], field[spot.at[3]]};
}
template <class T>
V3<T> pick3(const Field<3>& f, const Spot& spot, int shift = 0) {
  return {pick<T>(f.at(0) + shift, spot), pick<T>(f.at(1) + shift, spot), pick<T>(f.at(2) + shift, spot)};
}
template <class T>
Q4<T> pick4(const Field<4>& f, const Spot& spot, int shift = 0) {
  return {pick<T>(f.at(0) + shift, spot), pick<T>(f.at(1) + shift, spot), pick<T>(f.at(2) + shift, spot),
          pick<T>(f.at(3) + shift, spot)};
}
template <class T>
V3<T> mixed3(const Field<3>& f, const Spot& spot, T part) {
  const V3<T> a = pick3<T>(f, spot);
  return madd(part, pick3<T>(f, spot, 1) - a, a);
}
template <class T>
Q4<T> mixed4(const Field<4>& f, const Spot& spot, T part) {
  const Q4<T> a = pick4<T>(f, spot), b = pick4<T>(f, spot, 1);
  const T cosine = madd(a.w, b.w, madd(a.x, b.x, madd(a.y, b.y, a.z * b.z)));
  const T sign = with_sign(part, cosine), rest = 1.0 - part;
  return normalised(Q4<T>{madd(rest, a.w, sign * b.w), madd(rest, a.x, sign * b.x), madd(rest, a.y, sign * b.y),
                          madd(rest, a.z, sign * b.z)});
}

/// Shortest rotation from one unit vector to another; not normalised.
template <class T>
Q4<T> swing(const V3<T>& from, const V3<T>& to) {
  const V3<T> axis = cross(from, to);
  const T w = 1.0 + dot(from, to);  // almost never near 0, where any rotation is as short
  return {largest(w, T{} + 1e-6), axis.x, axis.y, axis.z};
}

}  // namespace ostium::core
