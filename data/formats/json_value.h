#pragma once
/// JSON written by hand: every value knows its file, line and path, so that messages can say where an error is.
/// Stricter than JSON: a repeated key in an object is an error.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "data/formats/load_error.h"

namespace ostium::data {

struct JsonValue {
  enum class Type { null, boolean, number, text, array, object };
  Type type = Type::null;
  double number = 0;                                       ///< number, or 0 or 1 for a boolean
  std::string text;                                        ///< text, UTF-8
  std::vector<JsonValue> items;                            ///< elements of an array
  std::vector<std::pair<std::string, JsonValue>> members;  ///< members of an object, in file order

  int line = 0;                             ///< where the value begins, from 1
  std::string path;                         ///< "sections.list[2].EI_Nmm2"; empty for the whole file
  std::shared_ptr<const std::string> file;  ///< file name

  const JsonValue* find(const std::string& key) const;  ///< null if there is no such member

  /// Throws LoadError "FILE:LINE: PATH is FOUND; expected EXPECTED".
  [[noreturn]] void refuse(const std::string& expected) const;
  /// Throws LoadError "FILE:LINE: WHAT".
  [[noreturn]] void fail(const std::string& what) const;
};

/// Throws LoadError if `text` is not JSON, nests deeper than 32, or repeats a key.
JsonValue parse_json(const std::string& file, const std::string& text);

/// Parses the whole file. Throws LoadError also if it cannot be read.
JsonValue load_json(const std::string& file);

/// Text that `parse_json` reads back to the same values; lines, paths and file names are not kept.
std::string to_json(const JsonValue& value);

}  // namespace ostium::data
