#include "data/formats/json/json_schema.h"

namespace ostium::data {

namespace {

/// Whether a value is a number, a boolean or one of a list: no text, nothing nested.
bool is_plain(const JsonType& type) {
  const auto& [word, value] = type.schema.front();
  return word == "enum" || word == "const" ||
         (word == "type" && (value.text == "number" || value.text == "integer" || value.text == "boolean"));
}

JsonType or_a_values_name(const JsonType& type) {
  return json_type::either({type, {{{"type", json_text("string")}, {"pattern", json_text("^\\$.")}}}});
}

JsonValue property(const JsonKey& key, bool values_stand_in) {
  std::vector<JsonMember> words =
      (values_stand_in && is_plain(key.type) ? or_a_values_name(key.type) : key.type).schema;
  words.emplace_back("description", json_text(key.expected));
  return json_object(std::move(words));
}

JsonValue definition(const JsonObjectKeys& object) {
  std::vector<JsonMember> properties;
  std::vector<std::string> required;
  for (const JsonKey& key : object.keys) {
    properties.emplace_back(key.name, property(key, object.values_stand_in));
    if (key.required) required.push_back(key.name);
  }
  std::vector<JsonMember> words = {
      {"type", json_text("object")}, {"additionalProperties", json_boolean(false)}, {"required", json_list(required)}};
  words.insert(words.end(), object.rules.begin(), object.rules.end());
  words.emplace_back("properties", json_object(std::move(properties)));
  return json_object(std::move(words));
}

}  // namespace

JsonValue schema_of(const JsonFormat& format) {
  std::vector<JsonMember> objects;
  for (const JsonObjectKeys* object : format.objects) objects.emplace_back(object->object, definition(*object));
  return json_object({{"$schema", json_text("https://json-schema.org/draft/2020-12/schema")},
                      {"$id", json_text(format.id)},
                      {"title", json_text(format.title)},
                      {"$ref", json_text("#/$defs/" + format.objects.front()->object)},
                      {"$defs", json_object(std::move(objects))}});
}

}  // namespace ostium::data
