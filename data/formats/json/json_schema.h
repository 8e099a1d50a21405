#pragma once
/// The JSON schema of a file format, generated from the same tables of keys that its reader uses.
#include "data/formats/json/json_object.h"

namespace ostium::data {

struct JsonFormat {
  std::string id;                              ///< "ostium-script/1"
  std::string title;                           ///< what such a file is
  std::vector<const JsonObjectKeys*> objects;  ///< the file's own object first, then the nested ones
  std::string form = "";                       ///< of a format that has several, each with a schema of its own
};

/// A JSON schema (draft 2020-12), with each object under its name in "$defs".
JsonValue schema_of(const JsonFormat& format);

}  // namespace ostium::data
