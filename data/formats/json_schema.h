#pragma once
/// The JSON schema of a file format, made of the same tables of keys that its reader goes by.
#include "data/formats/json_object.h"

namespace ostium::data {

struct JsonFormat {
  std::string id;                              ///< "ostium-script/1"
  std::string title;                           ///< what such a file is
  std::vector<const JsonObjectKeys*> objects;  ///< the file's own first, then those that stand in it
};

/// A JSON schema (draft 2020-12): each of the objects under its name in "$defs".
JsonValue schema_of(const JsonFormat& format);

}  // namespace ostium::data
