#pragma once
/// Values of a script: what its steps leave open, so that one script serves where others differ by a number.
#include "data/formats/json_value.h"

namespace ostium::data {

/// Puts a script's values in place: `"values": { "pushed_mm": 40 }` says what "$pushed_mm" stands for in its steps,
/// unless `given` (may be null) says otherwise. A step with `"when": "$NAME"` goes where that is false, one with
/// `"when_not"` where it is true. Scripts without `values` stay as they are. Returns whether there were values. Throws
/// LoadError with file, line and cure.
bool write_out_values(JsonValue& script, const JsonValue* given);

}  // namespace ostium::data
