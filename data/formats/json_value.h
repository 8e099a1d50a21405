#pragma once
/// JSON as people write it by hand: every value knows its file, line and path, so that what is wrong can be named.
/// Stricter than JSON asks for: a key that stands twice in one object is an error.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "data/formats/load_error.h"

namespace ostium::data {

struct JsonValue {
  enum class Type { null, boolean, number, text, array, object };
  Type type = Type::null;
  double number = 0;                                       ///< of a number; 0 or 1 of a boolean
  std::string text;                                        ///< of a text, UTF-8
  std::vector<JsonValue> items;                            ///< of an array
  std::vector<std::pair<std::string, JsonValue>> members;  ///< of an object, in the order of the file

  int line = 0;                             ///< where it begins, from 1
  std::string path;                         ///< "sections.list[2].EI_Nmm2"; empty for the whole file
  std::shared_ptr<const std::string> file;  ///< its name

  const JsonValue* find(const std::string& key) const;  ///< null if there is no such member

  /// Throws LoadError "FILE:LINE: PATH is FOUND; expected EXPECTED".
  [[noreturn]] void refuse(const std::string& expected) const;
  /// Throws LoadError "FILE:LINE: WHAT".
  [[noreturn]] void fail(const std::string& what) const;
};

/// Throws LoadError if `text` is not JSON, nests deeper than 32, or repeats a key.
JsonValue parse_json(const std::string& file, const std::string& text);

/// The whole file. Throws LoadError also if it cannot be read.
JsonValue load_json(const std::string& file);

/// As text that `parse_json` makes the same values of; lines, paths and files are not in it.
std::string to_json(const JsonValue& value);

}  // namespace ostium::data
