#include "data/catalogue/script/script_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <unordered_map>

namespace ostium::data {

namespace {

using Type = JsonValue::Type;

/// What "$NAME" stands for, by NAME.
using ValuesByName = std::unordered_map<std::string_view, const JsonValue*>;

/// Of a value that is a text: the name of a place or of a label. It may be put into every step.
constexpr std::size_t longest_text = 200;

std::string names_of(const JsonValue& values) {
  std::string names;
  for (const auto& [name, value] : values.members) names += (names.empty() ? "" : ", ") + name;
  return names.empty() ? "none" : names;
}

const char* word_for(Type type) {
  return type == Type::number ? "a number" : type == Type::boolean ? "true or false" : "a text";
}

void require_object(const JsonValue& values) {
  if (values.type != Type::object) values.refuse("values by their names, an object");
}

/// The script's own values, overridden by the given ones.
JsonValue merged(JsonValue own, const JsonValue& given) {
  require_object(given);
  for (const auto& [name, value] : given.members) {
    const auto is_it = [&, n = &name](const auto& member) { return member.key == *n; };
    const auto found = std::find_if(own.members.begin(), own.members.end(), is_it);
    if (found == own.members.end())
      value.fail(fmt::format("{} is no value of {}; expected one of {}", value.path(), *own.file, names_of(own)));
    if (value.type != found->value.type) value.refuse(word_for(found->value.type));
    found->value = value;
  }
  return own;
}

/// Substitutes values wherever "$NAME" occurs in `where`. Error messages about a value name both the place of use and
/// the file and line where it was given.
void put(const JsonValue& values, const ValuesByName& by_name, JsonValue& where) {
  if (where.type == Type::text && where.text.starts_with("$")) {
    const auto found = by_name.find(std::string_view(where.text).substr(1));
    if (found == by_name.end()) where.refuse("the name of one of the script's values: " + names_of(values));
    const JsonValue* value = found->second;
    std::shared_ptr<const JsonPlace> place = where.place;
    where = *value;
    where.place = std::move(place);
  }
  for (JsonValue& item : where.items) put(values, by_name, item);
  for (auto& [name, member] : where.members) put(values, by_name, member);
}

/// Whether a step is kept, by its `when` and `when_not`, which are removed from it.
bool stays(JsonValue& step) {
  bool stays = true;
  for (const bool wanted : {true, false}) {
    const std::string key = wanted ? "when" : "when_not";
    const JsonValue* says = step.find(key);
    if (!says) continue;
    if (says->type != Type::boolean) says->refuse("a value that is true or false");
    stays = stays && (says->number != 0) == wanted;
    std::erase_if(step.members, [&](const auto& member) { return member.key == key; });
  }
  return stays;
}

}  // namespace

bool write_out_values(JsonValue& script, const JsonValue* given) {
  JsonValue* steps = nullptr;
  for (auto& [name, member] : script.members)
    if (name == "steps") steps = &member;
  const JsonValue* own = script.find("values");
  if (!own && given) given->fail(fmt::format("{}: {} has no values", given->path(), *script.file));
  if (!own || !steps) return false;
  require_object(*own);
  for (const auto& [name, value] : own->members)
    if (value.type != Type::number && value.type != Type::boolean && value.type != Type::text)
      value.refuse("a number, a text, true or false");
  const JsonValue values = given ? merged(*own, *given) : *own;
  ValuesByName by_name;
  for (const auto& [name, value] : values.members) {
    if (value.text.size() > longest_text) value.refuse(fmt::format("a text of at most {} bytes", longest_text));
    by_name[name] = &value;
  }
  put(values, by_name, *steps);
  std::vector<JsonValue> kept;
  for (JsonValue& step : steps->items)
    if (stays(step)) kept.push_back(std::move(step));
  steps->items = std::move(kept);
  std::erase_if(script.members, [](const auto& member) { return member.key == "values"; });
  return true;
}

}  // namespace ostium::data
