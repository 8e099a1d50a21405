#pragma once
/// JSON written by hand: every value knows its file, line and path, so that messages can say where an error is.
/// Stricter than JSON: a repeated key in an object is an error, and there are limits, so that no file takes more than
/// a second or 500 MB.
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/formats/load_error.h"

namespace ostium::data {

/// What is beyond a limit is refused by name. The largest files that people have (measured sets) stay far below.
namespace json_limits {
inline constexpr std::size_t bytes = 16 << 20;    ///< of a file
inline constexpr std::size_t depth = 32;          ///< objects and arrays in one another
inline constexpr std::size_t values = 1'000'000;  ///< of a file, arrays and objects included
inline constexpr std::size_t keys = 4096;         ///< of one object
inline constexpr std::size_t key_bytes = 200;     ///< of one key
inline constexpr std::size_t text_bytes = 65536;  ///< of one text
}  // namespace json_limits

/// Where a value stands: a link of a chain, so that a million elements do not keep a million copies of a long path.
struct JsonPlace {
  std::shared_ptr<const JsonPlace> parent;  ///< null: the value of the whole file
  std::string key;
  std::optional<std::size_t> index;  ///< of an element of an array, which has no key
};

struct JsonMember;

struct JsonValue {
  enum class Type { null, boolean, number, text, array, object };
  Type type = Type::null;
  double number = 0;                ///< number, or 0 or 1 for a boolean
  std::string text;                 ///< text, UTF-8
  std::vector<JsonValue> items;     ///< elements of an array
  std::vector<JsonMember> members;  ///< of an object, in file order

  int line = 0;                             ///< where the value begins, from 1
  std::shared_ptr<const JsonPlace> place;   ///< null for the whole file
  std::shared_ptr<const std::string> file;  ///< file name

  std::string path() const;                             ///< "sections.list[2].EI_Nmm2"; empty for the whole file
  const JsonValue* find(const std::string& key) const;  ///< null if there is no such member

  /// Throws LoadError "FILE:LINE: PATH is FOUND; expected EXPECTED".
  [[noreturn]] void refuse(const std::string& expected) const;
  /// Throws LoadError "FILE:LINE: WHAT".
  [[noreturn]] void fail(const std::string& what) const;
};

struct JsonMember {
  std::string key;
  JsonValue value;
};

/// Throws LoadError if `text` is not JSON in UTF-8, repeats a key, or goes beyond a limit.
JsonValue parse_json(const std::string& file, const std::string& text);

/// Parses the whole file. Throws LoadError also if it cannot be read.
JsonValue load_json(const std::string& file);

/// Text that `parse_json` reads back to the same values; lines, paths and file names are not kept.
std::string to_json(const JsonValue& value);

}  // namespace ostium::data
