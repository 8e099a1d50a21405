#pragma once
/// Strict access to a JSON object with known keys: an unknown or missing key or a value of the wrong type throws
/// LoadError with file, line, key, value found and what was expected.
#include <optional>
#include <utility>

#include "data/formats/json/json_type.h"
#include "data/formats/json/json_value.h"

namespace ostium::data {

struct JsonKey {
  std::string name;
  bool required = true;
  std::string expected;  ///< how messages and the schema describe it: "bending stiffness in N mm2, > 0"
  JsonType type = {};
};

/// The keys of one kind of object, under its name in the schema ("$defs"). Shared by readers and schemas.
struct JsonObjectKeys {
  std::string object;
  std::vector<JsonKey> keys;
  std::vector<JsonMember> rules = {};  ///< which keys go together; the reader checks this itself
  bool values_stand_in = false;        ///< "$NAME" may stand for a number, a boolean or a choice (script_values.h)
};

class JsonObject {
 public:
  /// Refuses a value that is not an object, a key not in `keys`, a missing required key, and a text, number, boolean,
  /// list or object in place of another, whether it is read or not. Keeps references to both.
  JsonObject(const JsonValue& value, const JsonObjectKeys& keys);

  const JsonValue& value() const { return value_; }
  bool has(const std::string& key) const { return value_.find(key) != nullptr; }
  const JsonValue& operator[](const std::string& key) const;  ///< the key must be present

  double positive(const std::string& key) const;
  double not_negative(const std::string& key) const;
  double number(const std::string& key) const;  ///< within the range of the key's type
  int whole(const std::string& key) const;      ///< the same, an integer
  /// The same; nothing where the value is null or the key, which need not be there, is absent.
  std::optional<double> number_or_null(const std::string& key) const;
  std::vector<double> numbers(const std::string& key, std::size_t count) const;
  bool boolean(const std::string& key) const;
  std::string text(const std::string& key) const;  ///< not empty
  const std::vector<JsonValue>& list(const std::string& key) const;
  /// Index of the text among `choices`, which the message lists.
  std::size_t choice(const std::string& key, const std::vector<std::string>& choices) const;
  /// Refuses the value of `key`; the message gives the description from `keys`.
  [[noreturn]] void refuse(const std::string& key) const;

 private:
  const JsonKey& known(const std::string& key) const;

  const JsonValue& value_;
  const JsonObjectKeys& keys_;
};

}  // namespace ostium::data
