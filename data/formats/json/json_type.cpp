#include "data/formats/json/json_type.h"

#include <cmath>

namespace ostium::data {

JsonValue json_text(const std::string& text) {
  JsonValue value;
  value.type = JsonValue::Type::text, value.text = text;
  return value;
}

JsonValue json_number(double number) {
  JsonValue value;
  value.type = JsonValue::Type::number, value.number = number;
  return value;
}

JsonValue json_boolean(bool is_true) {
  JsonValue value;
  value.type = JsonValue::Type::boolean, value.number = is_true;
  return value;
}

JsonValue json_list(std::vector<JsonValue> items) {
  JsonValue value;
  value.type = JsonValue::Type::array, value.items = std::move(items);
  return value;
}

JsonValue json_list(const std::vector<std::string>& texts) {
  std::vector<JsonValue> items;
  for (const std::string& text : texts) items.push_back(json_text(text));
  return json_list(std::move(items));
}

JsonValue json_object(std::vector<JsonMember> members) {
  JsonValue value;
  value.type = JsonValue::Type::object, value.members = std::move(members);
  return value;
}

JsonMember one_of_required(const std::vector<std::vector<std::string>>& sets) {
  std::vector<JsonValue> items;
  for (const std::vector<std::string>& set : sets) items.push_back(json_object({{"required", json_list(set)}}));
  return {"oneOf", json_list(std::move(items))};
}

JsonMember required_together(const std::string& a, const std::string& b) {
  return {"dependentRequired", json_object({{a, json_list({json_text(b)})}, {b, json_list({json_text(a)})}})};
}

JsonMember at_least_properties(int count) { return {"minProperties", json_number(count)}; }

namespace json_type {

namespace {

JsonType named(const char* type) { return {{{"type", json_text(type)}}}; }

JsonType ranged(const char* type, const JsonRange& range) {
  JsonType out = named(type);
  const auto bound = [&](const char* keyword, double value) {
    if (std::isfinite(value)) out.schema.emplace_back(keyword, json_number(value));
  };
  bound("minimum", range.least), bound("exclusiveMinimum", range.above);
  bound("maximum", range.most), bound("exclusiveMaximum", range.below);
  out.range = range;
  return out;
}

JsonValue schemas_of(const std::vector<JsonType>& types) {
  std::vector<JsonValue> items;
  for (const JsonType& type : types) items.push_back(json_object(type.schema));
  return json_list(std::move(items));
}

}  // namespace

JsonType text() {
  JsonType out = named("string");
  out.schema.emplace_back("minLength", json_number(1));
  return out;
}

JsonType number(const JsonRange& range) { return ranged("number", range); }

JsonType whole(const JsonRange& range) { return ranged("integer", range); }

JsonType boolean() { return named("boolean"); }

JsonType only_true() { return {{{"const", json_boolean(true)}}}; }

JsonType constant(const std::string& text) { return {{{"const", json_text(text)}}}; }

JsonType choice(const std::vector<std::string>& names) { return {{{"enum", json_list(names)}}}; }

JsonType one_of_numbers(const std::vector<double>& numbers) {
  std::vector<JsonValue> items;
  for (double number : numbers) items.push_back(json_number(number));
  return {{{"enum", json_list(std::move(items))}}};
}

JsonType object(const std::string& name) { return {{{"$ref", json_text("#/$defs/" + name)}}}; }

JsonType values_by_name(const std::vector<JsonType>& types) {
  JsonType out = named("object");
  out.schema.emplace_back("additionalProperties",
                          json_object(types.size() == 1 ? types[0].schema : either(types).schema));
  return out;
}

JsonType list_of(const JsonType& item, int at_least, int at_most) {
  JsonType out = named("array");
  out.schema.emplace_back("items", json_object(item.schema));
  if (at_least > 0) out.schema.emplace_back("minItems", json_number(at_least));
  if (at_most > 0) out.schema.emplace_back("maxItems", json_number(at_most));
  return out;
}

JsonType numbers(int count, const JsonRange& range) {
  JsonType type = list_of(number(range), count, count);
  type.range = range;
  return type;
}

JsonType either(const std::vector<JsonType>& types) { return {{{"oneOf", schemas_of(types)}}}; }

JsonType null_or(const JsonType& type) {
  JsonType out = either({named("null"), type});
  out.range = type.range;
  return out;
}

}  // namespace json_type

}  // namespace ostium::data
