#pragma once
/// Strict access to a JSON object whose keys are known: what is unknown, missing or of the wrong kind throws LoadError
/// with file, line, key, value found and what was expected.
#include <utility>

#include "data/formats/json_type.h"
#include "data/formats/json_value.h"

namespace ostium::data {

struct JsonKey {
  std::string name;
  bool required = true;
  std::string expected;  ///< what a message and the schema say of it: "bending stiffness in N mm2, > 0"
  JsonType type = {};
};

/// The keys of one kind of object, under the name that the schema gives it ("$defs"). Readers and schemas both go by
/// it.
struct JsonObjectKeys {
  std::string object;
  std::vector<JsonKey> keys;
  std::vector<SchemaKeyword> rules = {};  ///< which keys go together, for the schema; the reader has its own words
};

class JsonObject {
 public:
  /// Refuses what is no object, a key that `keys` does not list and a required one that is missing. Keeps references to
  /// both.
  JsonObject(const JsonValue& value, const JsonObjectKeys& keys);

  const JsonValue& value() const { return value_; }
  bool has(const std::string& key) const { return value_.find(key) != nullptr; }
  const JsonValue& operator[](const std::string& key) const;  ///< `key` is there

  double positive(const std::string& key) const;
  double not_negative(const std::string& key) const;
  double number(const std::string& key) const;  ///< within the range that the key's type says
  int whole(const std::string& key) const;      ///< the same, without a fraction
  std::vector<double> numbers(const std::string& key, std::size_t count) const;
  bool boolean(const std::string& key) const;
  std::string text(const std::string& key) const;  ///< not empty
  const std::vector<JsonValue>& list(const std::string& key) const;
  /// Index of the text among `choices`; the message lists them.
  std::size_t choice(const std::string& key, const std::vector<std::string>& choices) const;
  /// Refuses the value of `key`, in the words of the list of keys.
  [[noreturn]] void refuse(const std::string& key) const;

 private:
  const JsonKey& known(const std::string& key) const;

  const JsonValue& value_;
  const JsonObjectKeys& keys_;
};

}  // namespace ostium::data
