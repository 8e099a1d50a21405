#pragma once
/// The type of a key's value: its JSON schema keywords, and the range that a reader enforces.
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "data/formats/json/json_value.h"

namespace ostium::data {

/// A range of numbers: above < x < below, least <= x <= most.
struct JsonRange {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  double above = -infinity, least = -infinity, below = infinity, most = infinity;
  constexpr bool holds(double x) const { return x > above && x >= least && x < below && x <= most; }
};
inline constexpr JsonRange above_zero = {.above = 0}, from_zero = {.least = 0};
constexpr JsonRange above_zero_to(double most) { return {.above = 0, .most = most}; }
constexpr JsonRange from_to(double least, double most) { return {.least = least, .most = most}; }

/// A keyword of a schema and its value.

struct JsonType {
  std::vector<JsonMember> schema;
  JsonRange range = {};  ///< of a number, or of each of `numbers`; JsonObject refuses values outside
};

namespace json_type {

JsonType text();  ///< not empty
JsonType number(const JsonRange& range = {});
JsonType whole(const JsonRange& range = {});
JsonType boolean();
JsonType only_true();
JsonType constant(const std::string& text);
JsonType choice(const std::vector<std::string>& names);
JsonType one_of_numbers(const std::vector<double>& numbers);
JsonType object(const std::string& name);  ///< one of the file's objects, by the name of its JsonObjectKeys
JsonType values_by_name(const std::vector<JsonType>& either);
JsonType list_of(const JsonType& item, int at_least = 0, int at_most = 0);  ///< at_most 0: any number
JsonType numbers(int count, const JsonRange& range = {});
JsonType either(const std::vector<JsonType>& types);
JsonType null_or(const JsonType& type);

}  // namespace json_type

/// Rules on which keys of an object go together.
JsonMember one_of_required(const std::vector<std::vector<std::string>>& sets);
JsonMember required_together(const std::string& a, const std::string& b);
JsonMember at_least_properties(int count);

/// JSON values for schemas.
JsonValue json_text(const std::string& text);
JsonValue json_number(double number);
JsonValue json_boolean(bool value);
JsonValue json_list(std::vector<JsonValue> items);
JsonValue json_list(const std::vector<std::string>& texts);
JsonValue json_object(std::vector<JsonMember> members);

}  // namespace ostium::data
