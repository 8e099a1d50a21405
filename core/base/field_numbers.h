#pragma once
/// The kinds of number in a state (fields.h): how each is hashed and stored in a row of doubles. Also counts the
/// members of a struct.
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>

namespace ostium::core {

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_number = std::is_arithmetic_v<T> || std::is_enum_v<T> || is_optional<T>;

/// As a double, exactly: 64-bit integers keep their bit pattern; an empty optional is -1.
template <class T>
double to_double(const T& number) {
  if constexpr (is_optional<T>)
    return number ? to_double(*number) : -1;
  else if constexpr (std::is_enum_v<T>)
    return to_double(static_cast<std::underlying_type_t<T>>(number));
  else if constexpr (std::is_integral_v<T> && sizeof(T) == sizeof(double))
    return std::bit_cast<double>(number);
  else
    return static_cast<double>(number);
}

template <class T>
void from_double(double from, T& number) {
  if constexpr (is_optional<T>) {
    number.reset();
    if (from != -1) from_double(from, number.emplace());
  } else if constexpr (std::is_enum_v<T>) {
    std::underlying_type_t<T> value;
    from_double(from, value);
    number = static_cast<T>(value);
  } else if constexpr (std::is_integral_v<T> && sizeof(T) == sizeof(double)) {
    number = std::bit_cast<T>(from);
  } else {
    number = static_cast<T>(from);
  }
}

/// XXH3; -0 and 0 hash differently.
std::uint64_t hash_bytes(const void* first, std::size_t bytes, std::uint64_t seed);

/// Hashes each number as the bytes of its own type (no padding), an optional as its double.
template <class T>
std::uint64_t hash_numbers(std::span<const T> numbers, std::uint64_t h) {
  static_assert(is_optional<T> || std::is_floating_point_v<T> || std::has_unique_object_representations_v<T>);
  if constexpr (is_optional<T>)
    for (const T& one : numbers) {
      const double number = to_double(one);
      h = hash_bytes(&number, sizeof number, h);
    }
  else
    h = hash_bytes(numbers.data(), numbers.size_bytes(), h);
  return h;
}

std::string difference_in_words(const std::string& path, int index, const std::string& a, const std::string& b);
std::string in_words(double number);  ///< shortest text that reads back as the same number
std::string in_words(std::uint64_t number);

template <class T>
std::string number_in_words(const T& number) {
  if constexpr (std::is_integral_v<T> && sizeof(T) == sizeof(double))
    return in_words(static_cast<std::uint64_t>(number));
  else
    return in_words(to_double(number));
}
/// "path[index]: a != b", with `b` as stored in a row.
template <class T>
std::string difference_in_words(const std::string& path, int index, const T& a, double b) {
  T other{};
  from_double(b, other);
  return difference_in_words(path, index, number_in_words(a), number_in_words(other));
}

/// Converts to any type, so it can initialise any member of an aggregate.
struct Anything {
  template <class T>
  operator T() const;
};

/// Number of members of an aggregate: the most initialisers that it accepts. (No member may be a plain array.)
template <class S, class... Some>
consteval std::size_t member_count() {
  static_assert(std::is_aggregate_v<S>);
  if constexpr (requires { S{Some{}..., Anything{}}; })
    return member_count<S, Some..., Anything>();
  else
    return sizeof...(Some);
}

}  // namespace ostium::core
