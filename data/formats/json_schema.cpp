#include "data/formats/json_schema.h"

namespace ostium::data {

namespace {

JsonValue property(const JsonKey& key) {
  std::vector<SchemaKeyword> words = key.type.schema;
  words.emplace_back("description", json_text(key.expected));
  return json_object(std::move(words));
}

JsonValue definition(const JsonObjectKeys& object) {
  std::vector<SchemaKeyword> properties;
  std::vector<std::string> required;
  for (const JsonKey& key : object.keys) {
    properties.emplace_back(key.name, property(key));
    if (key.required) required.push_back(key.name);
  }
  std::vector<SchemaKeyword> words = {
      {"type", json_text("object")}, {"additionalProperties", json_boolean(false)}, {"required", json_list(required)}};
  words.insert(words.end(), object.rules.begin(), object.rules.end());
  words.emplace_back("properties", json_object(std::move(properties)));
  return json_object(std::move(words));
}

}  // namespace

JsonValue schema_of(const JsonFormat& format) {
  std::vector<SchemaKeyword> objects;
  for (const JsonObjectKeys* object : format.objects) objects.emplace_back(object->object, definition(*object));
  return json_object({{"$schema", json_text("https://json-schema.org/draft/2020-12/schema")},
                      {"$id", json_text(format.id)},
                      {"title", json_text(format.title)},
                      {"$ref", json_text("#/$defs/" + format.objects.front()->object)},
                      {"$defs", json_object(std::move(objects))}});
}

}  // namespace ostium::data
