#include "data/formats/json/json_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace ostium::data {

namespace {

/// Whether a value is of the one sort that the key's schema names; where it names several, or none, the reader looks.
bool is_of(const JsonType& type, const JsonValue& value) {
  using Type = JsonValue::Type;
  const auto named =
      std::find_if(type.schema.begin(), type.schema.end(), [](const auto& m) { return m.key == "type"; });
  if (named == type.schema.end()) return true;
  const std::string& name = named->value.text;
  if (name == "string") return value.type == Type::text && !value.text.empty();
  if (name == "boolean") return value.type == Type::boolean;
  if (name == "array") return value.type == Type::array;
  if (name == "object") return value.type == Type::object;
  return value.type == Type::number && type.range.holds(value.number);
}

}  // namespace

JsonObject::JsonObject(const JsonValue& value, const JsonObjectKeys& keys) : value_(value), keys_(keys) {
  if (value.type != JsonValue::Type::object) value.refuse("an object {...}: the " + keys.object);
  for (const auto& [name, member] : value.members) {
    if (std::any_of(keys.keys.begin(), keys.keys.end(), [&, key = &name](const JsonKey& k) { return k.name == *key; }))
      continue;
    std::string known;
    for (const JsonKey& key : keys.keys) known += (known.empty() ? "" : ", ") + key.name;
    member.fail(fmt::format("{} is not a key of the {}; expected one of {}", member.path(), keys.object, known));
  }
  for (const JsonKey& key : keys.keys)
    if (key.required && !has(key.name))
      value.fail(fmt::format("{}{}{} is missing; expected {}", value.path(), value.path().empty() ? "" : ".", key.name,
                             key.expected));
  for (const JsonKey& key : keys.keys)
    if (const JsonValue* member = value.find(key.name); member && !is_of(key.type, *member)) refuse(key.name);
}

const JsonValue& JsonObject::operator[](const std::string& key) const {
  const JsonValue* member = value_.find(key);
  assert(member);
  return *member;
}

const JsonKey& JsonObject::known(const std::string& key) const {
  const auto is_it = [&](const JsonKey& k) { return k.name == key; };
  const auto found = std::find_if(keys_.keys.begin(), keys_.keys.end(), is_it);
  assert(found != keys_.keys.end());
  return *found;
}

void JsonObject::refuse(const std::string& key) const { (*this)[key].refuse(known(key).expected); }

namespace {

/// Where no range was said: nothing in any unit of a file is as large, and sums of squares stay finite.
void require_sound(const JsonValue& value, const JsonKey& key) {
  constexpr double most = 1e12;
  const JsonRange& range = key.type.range;
  const bool endless_up = std::isinf(std::min(range.most, range.below)),
             endless_down = std::isinf(std::max(range.least, range.above));
  if ((endless_up && !(value.number <= most)) || (endless_down && !(value.number >= -most)))
    value.refuse(key.expected + "; no number beyond 1e12 is");
}

}  // namespace

double JsonObject::number(const std::string& key) const {
  const JsonValue& value = (*this)[key];
  if (value.type != JsonValue::Type::number || !known(key).type.range.holds(value.number)) refuse(key);
  require_sound(value, known(key));
  return value.number;
}

int JsonObject::whole(const std::string& key) const {
  const double value = number(key);
  if (value != std::floor(value) || std::fabs(value) > std::numeric_limits<int>::max()) refuse(key);
  return static_cast<int>(value);
}

std::optional<double> JsonObject::number_or_null(const std::string& key) const {
  if (!has(key) || (*this)[key].type == JsonValue::Type::null) return std::nullopt;
  return number(key);
}

double JsonObject::positive(const std::string& key) const {
  if (!(number(key) > 0)) refuse(key);
  return number(key);
}

double JsonObject::not_negative(const std::string& key) const {
  if (!(number(key) >= 0)) refuse(key);
  return number(key);
}

bool JsonObject::boolean(const std::string& key) const {
  if ((*this)[key].type != JsonValue::Type::boolean) refuse(key);
  return (*this)[key].number != 0;
}

std::vector<double> JsonObject::numbers(const std::string& key, std::size_t count) const {
  const std::vector<JsonValue>& items = list(key);
  std::vector<double> result;
  for (const JsonValue& item : items) {
    if (item.type != JsonValue::Type::number || !known(key).type.range.holds(item.number)) refuse(key);
    require_sound(item, known(key));
    result.push_back(item.number);
  }
  if (result.size() != count) refuse(key);
  return result;
}

std::string JsonObject::text(const std::string& key) const {
  const JsonValue& member = (*this)[key];
  if (member.type != JsonValue::Type::text || member.text.empty()) refuse(key);
  return member.text;
}

const std::vector<JsonValue>& JsonObject::list(const std::string& key) const {
  if ((*this)[key].type != JsonValue::Type::array) refuse(key);
  return (*this)[key].items;
}

std::size_t JsonObject::choice(const std::string& key, const std::vector<std::string>& choices) const {
  const JsonValue& member = (*this)[key];
  const auto chosen = std::find(choices.begin(), choices.end(), member.text);
  if (member.type != JsonValue::Type::text || chosen == choices.end()) {
    std::string known;
    for (const std::string& choice : choices) known += (known.empty() ? "" : ", ") + choice;
    member.refuse("one of " + known);
  }
  return static_cast<std::size_t>(chosen - choices.begin());
}

}  // namespace ostium::data
