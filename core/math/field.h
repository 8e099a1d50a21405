#pragma once
/// A field along a rod: K numbers per node, joint or element, stored component by component so that four neighbours
/// load into one register.
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/math/lanes.h"

namespace ostium::core {

/// Storage length for `count` entries: whole registers, plus four entries of padding that only the block-tridiagonal
/// solver uses. Kept away from multiples of a page, where the components of an entry would compete for the same cache
/// lines.
inline int padded(int count) {
  const int page = 4096 / sizeof(double), apart = page / 8;
  const int whole = (count + lane_count - 1) / lane_count * lane_count + lane_count;
  return whole % page < apart && whole > page ? whole + apart : whole;
}

/// `size()` entries of K doubles. Component c of entry i is `at(c)[i]`, with i < stride(). Allocates in `resize` only.
template <int K>
class Field {
 public:
  static constexpr int components = K;

  Field() = default;
  explicit Field(int size) { resize(size); }

  void resize(int size) {
    size_ = size;
    stride_ = padded(size);
    data_.assign(static_cast<std::size_t>(K) * stride_, 0.0);
  }
  int size() const { return size_; }
  int stride() const { return stride_; }

  double* at(int component) { return data_.data() + static_cast<std::ptrdiff_t>(component) * stride_; }
  const double* at(int component) const { return data_.data() + static_cast<std::ptrdiff_t>(component) * stride_; }

  Eigen::Matrix<double, K, 1> operator[](int i) const {
    Eigen::Matrix<double, K, 1> value;
    for (int c = 0; c < K; ++c) value[c] = at(c)[i];
    return value;
  }
  void set(int i, const Eigen::Matrix<double, K, 1>& value) {
    for (int c = 0; c < K; ++c) at(c)[i] = value[c];
  }
  void fill(const Eigen::Matrix<double, K, 1>& value) {
    for (int i = 0; i < stride_; ++i) set(i, value);
  }

  /// All numbers, including padding.
  std::vector<double>& raw() { return data_; }
  const std::vector<double>& raw() const { return data_; }

 private:
  int size_ = 0, stride_ = 0;
  std::vector<double> data_;
};

/// Copies entries begin to end - 1 of one field to another, starting there at `at`.
template <int K>
void copy_entries(const Field<K>& from, int begin, int end, Field<K>& to, int at) {
  for (int c = 0; c < K; ++c) std::copy(from.at(c) + begin, from.at(c) + end, to.at(c) + at);
}

/// Calls f(Lanes{}, i) for whole registers of [begin, end) and f(double{}, i) for the remaining entries. Both do the
/// same operations in the same order, so the result does not depend on which one is used.
template <class F>
void for_packs(int begin, int end, F&& f) {
  int i = begin;
  for (; i + lane_count <= end; i += lane_count) f(Lanes{}, i);
  for (; i < end; ++i) f(double{}, i);
}

// --- loading and storing registers -----------------------------------------------------------------------------------
template <class T>
[[gnu::always_inline]] inline V3<T> load3(const Field<3>& f, int i) {
  return {load<T>(f.at(0) + i), load<T>(f.at(1) + i), load<T>(f.at(2) + i)};
}
template <class T>
[[gnu::always_inline]] inline Q4<T> load4(const Field<4>& f, int i) {
  return {load<T>(f.at(0) + i), load<T>(f.at(1) + i), load<T>(f.at(2) + i), load<T>(f.at(3) + i)};
}
template <class T>
[[gnu::always_inline]] inline S3<T> load6(const Field<6>& f, int i) {
  return {load<T>(f.at(0) + i), load<T>(f.at(1) + i), load<T>(f.at(2) + i),
          load<T>(f.at(3) + i), load<T>(f.at(4) + i), load<T>(f.at(5) + i)};
}
template <class T>
[[gnu::always_inline]] inline void store3(Field<3>& f, int i, const V3<T>& a) {
  store(f.at(0) + i, a.x), store(f.at(1) + i, a.y), store(f.at(2) + i, a.z);
}
template <class T>
[[gnu::always_inline]] inline void store4(Field<4>& f, int i, const Q4<T>& a) {
  store(f.at(0) + i, a.w), store(f.at(1) + i, a.x), store(f.at(2) + i, a.y), store(f.at(3) + i, a.z);
}
template <class T>
[[gnu::always_inline]] inline void store6(Field<6>& f, int i, const S3<T>& a) {
  store(f.at(0) + i, a.xx), store(f.at(1) + i, a.xy), store(f.at(2) + i, a.xz);
  store(f.at(3) + i, a.yy), store(f.at(4) + i, a.yz), store(f.at(5) + i, a.zz);
}

}  // namespace ostium::core
