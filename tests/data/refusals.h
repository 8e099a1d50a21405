#pragma once
/// What tests of strict readers share.
#include <gtest/gtest.h>

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "data/formats/json_object.h"

namespace ostium {

inline void expect_words(const std::string& message, std::initializer_list<const char*> words) {
  for (const char* word : words) EXPECT_NE(message.find(word), std::string::npos) << message << "\n  lacks: " << word;
}

/// A reader and its schema know the same keys of an object, and require the same.
inline void expect_keys_of(const nlohmann::json& definition, const JsonObjectKeys& known) {
  std::set<std::string> keys, required, schema_keys, schema_required;
  for (const JsonKey& key : known.keys) {
    keys.insert(key.name);
    if (key.required) required.insert(key.name);
  }
  for (const auto& [key, value] : definition["properties"].items()) schema_keys.insert(key);
  for (const auto& key : definition["required"]) schema_required.insert(key);
  EXPECT_EQ(keys, schema_keys);
  EXPECT_EQ(required, schema_required);
}

}  // namespace ostium
