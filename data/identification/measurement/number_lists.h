#pragma once
/// Lists of numbers in measured sets.
#include <fmt/format.h>

#include <Eigen/Core>
#include <vector>

#include "data/formats/json/json_value.h"

namespace ostium::data {

/// `value` as `count` numbers; the error message says how many there are.
inline std::vector<double> numbers(const JsonValue& value, std::size_t count) {
  if (value.type != JsonValue::Type::array) value.refuse(fmt::format("{} numbers, [...]", count));
  std::vector<double> result;
  for (const JsonValue& item : value.items) {
    if (item.type != JsonValue::Type::number) item.refuse("a number");
    result.push_back(item.number);
  }
  if (result.size() != count) value.refuse(fmt::format("{} numbers, got {}", count, result.size()));
  return result;
}
inline Eigen::Vector3d vector3(const JsonValue& value) {
  return Eigen::Map<const Eigen::Vector3d>(numbers(value, 3).data());
}
inline Eigen::Vector2d vector2(const JsonValue& value) {
  return Eigen::Map<const Eigen::Vector2d>(numbers(value, 2).data());
}

}  // namespace ostium::data
