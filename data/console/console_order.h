#pragma once
/// A console's command as a message: {"do": "turn_arm", "values": [5, 0]} (data/schemas/console.schema.json).
#include <optional>
#include <string>

#include "data/console/console_commands.h"
#include "data/formats/json/json_object.h"

namespace ostium::data {

/// Null: there is none of that name.
const ConsoleRow* console_row(const std::string& name);

/// Throws LoadError naming what is wrong and what was expected: another number of values, one out of its range, a field
/// or frame rate that the system does not have.
ConsoleOrder read_console_order(const JsonValue& message);
ConsoleOrder read_console_order(const std::string& from, const std::string& text);

namespace console_keys_of_messages {
extern const std::vector<const JsonObjectKeys*> all;
}

}  // namespace ostium::data
