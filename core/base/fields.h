#pragma once
/// Each struct of state has one list of its members beside it. Hashing, recording (rows of numbers and back),
/// comparison and names all use this list.
///
///   struct Lamp { bool on = false; int watts = 0; };
///   constexpr auto fields(const Lamp*) { return std::tuple{field("on", &Lamp::on), field("watts", &Lamp::watts)}; }
///
/// Members are numbers (arithmetic types and enums, also optional ones), structs with a list, components along a rod
/// (core/math/field.h), and vectors, arrays and Eigen matrices of these. A member missing from the list is a compile
/// error.
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "core/base/field_numbers.h"

namespace ostium::core {

template <class S, class T>
struct ListedField {
  const char* name;
  T S::*member;
};
template <class S, class T>
constexpr ListedField<S, T> field(const char* name, T S::*member) {
  return {name, member};
}

/// Where a value is: names from the outermost struct inwards. Turned into text only on demand.
struct FieldPath {
  const FieldPath* outer = nullptr;
  const char* name = "";
  int index = -1;  ///< index of a struct in a vector or array

  std::string words() const;  ///< "treatment.stents[2].radius_m"
};

template <class S>
concept HasFields = requires(const S* s) {
  fields(s);
};

/// Whether the list has as many entries as the aggregate has members, each with its own name.
template <class S>
consteval bool lists_every_member() {
  return std::apply(
      [](const auto&... one) {
        const std::string_view names[] = {one.name...};
        for (std::size_t i = 0; i < sizeof...(one); ++i)
          for (std::size_t j = 0; j < i; ++j)
            if (names[i] == names[j]) return false;
        return sizeof...(one) == member_count<S>();
      },
      fields(static_cast<const S*>(nullptr)));
}

/// Calls visit(name, member) for each member. `S` may be const.
template <class S, class Visit>
void for_each_field(S& s, Visit&& visit) {
  using Plain = std::remove_const_t<S>;
  static_assert(lists_every_member<Plain>(), "fields(const S*) does not list every member of S once");
  std::apply([&](const auto&... one) { (visit(one.name, s.*one.member), ...); },
             fields(static_cast<const Plain*>(nullptr)));
}

/// Short vectors of numbers that lie side by side without a gap, as Eigen's do.
template <class V>
concept IsShortVector = requires {
  typename V::Scalar;
}
&&V::SizeAtCompileTime > 0 && sizeof(V) == sizeof(typename V::Scalar) * std::size_t(V::SizeAtCompileTime);

/// Calls visit(path, span) for all numbers of a member in the order of the lists; each span holds one type.
template <class T, class Visit>
void for_each_number(T& part, const FieldPath& path, Visit& visit) {
  using Plain = std::remove_const_t<T>;
  if constexpr (is_number<Plain>) {
    visit(path, std::span(&part, 1));
  } else if constexpr (HasFields<Plain>) {
    for_each_field(part, [&](const char* name, auto& member) { for_each_number(member, {&path, name}, visit); });
  } else if constexpr (requires { Plain::components; }) {
    for (int c = 0; c < Plain::components; ++c)
      visit(path, std::span(part.at(c), static_cast<std::size_t>(part.size())));
  } else if constexpr (is_number<std::decay_t<decltype(*part.data())>>) {
    visit(path, std::span(part.data(), static_cast<std::size_t>(part.size())));
  } else if constexpr (IsShortVector<std::decay_t<decltype(*part.data())>>) {
    using Each = std::decay_t<decltype(*part.data())>;
    auto* numbers = part.empty() ? nullptr : part.data()->data();
    visit(path, std::span(numbers, part.size() * static_cast<std::size_t>(Each::SizeAtCompileTime)));
  } else {
    for (std::size_t i = 0; i < part.size(); ++i)
      for_each_number(part[i], {path.outer, path.name, static_cast<int>(i)}, visit);
  }
}
template <class T, class Visit>
void for_each_number(T& part, Visit&& visit) {
  for_each_number(part, FieldPath{}, visit);
}

template <class T>
std::uint64_t hash_fields(const T& part, std::uint64_t h) {
  for_each_number(part, [&](const FieldPath&, auto numbers) { h = hash_numbers(numbers, h); });
  return h;
}

template <class T>
std::size_t count_fields(const T& part) {
  std::size_t count = 0;
  for_each_number(part, [&](const FieldPath&, auto numbers) { count += numbers.size(); });
  return count;
}

/// Writes count_fields numbers, each exactly; returns the end.
template <class T>
double* put_fields(const T& part, double* row) {
  for_each_number(part, [&](const FieldPath&, auto numbers) {
    for (const auto& one : numbers) *row++ = to_double(one);
  });
  return row;
}

/// Reads them back into a state of the same sizes.
template <class T>
const double* take_fields(const double* row, T& part) {
  for_each_number(part, [&](const FieldPath&, auto numbers) {
    for (auto& one : numbers) from_double(*row++, one);
  });
  return row;
}

/// "velocity[12]: 0.1 != 0.2" for the first difference, or empty if both are bit-identical.
template <class T>
std::string first_different_field(const T& a, const T& b) {
  std::vector<std::vector<double>> others;
  for_each_number(b, [&](const FieldPath&, auto numbers) {
    auto& row = others.emplace_back();
    for (const auto& one : numbers) row.push_back(to_double(one));
  });
  std::string found;
  std::size_t next = 0;
  for_each_number(a, [&](const FieldPath& path, auto numbers) {
    if (!found.empty()) return;
    if (next >= others.size() || others[next].size() != numbers.size()) {
      found = path.words() + ": sizes differ";
      return;
    }
    const std::vector<double>& other = others[next++];
    for (std::size_t i = 0; i < numbers.size() && found.empty(); ++i)
      if (std::bit_cast<std::uint64_t>(to_double(numbers[i])) != std::bit_cast<std::uint64_t>(other[i]))
        found = difference_in_words(path.words(), numbers.size() > 1 ? static_cast<int>(i) : -1, numbers[i], other[i]);
  });
  return found;
}

}  // namespace ostium::core
