#include "data/console/console_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ostium::data {

namespace {

std::vector<std::string> names() {
  std::vector<std::string> out;
  for (const ConsoleRow& row : console_rows) out.emplace_back(row.name);
  return out;
}

/// Those that have only some values within their range; null: any.
const std::vector<double>* choices(ConsoleCommand command) {
  static const std::vector<double> fields = {130, 160, 200}, rates = {3.75, 7.5, 15, 30}, switches = {0, 1};
  switch (command) {
    case ConsoleCommand::field:
      return &fields;
    case ConsoleCommand::frame_rate:
      return &rates;
    case ConsoleCommand::roadmap:
      return &switches;
    default:
      return nullptr;
  }
}

bool is_whole(ConsoleCommand command) {
  return command == ConsoleCommand::view || command == ConsoleCommand::review || command == ConsoleCommand::review_step;
}

std::string expected_of(const ConsoleRow& row) {
  if (row.values == 0) return fmt::format("no values, as \"{}\" has none", row.name);
  std::string of = fmt::format("{:g} to {:g}", row.least, row.most);
  if (const std::vector<double>* some = choices(row.command)) {
    of = "one of";
    for (const double one : *some) of += fmt::format(" {:g}", one);
  }
  return fmt::format("{} number{} for \"{}\" ({}), each {} {}", row.values, row.values == 1 ? "" : "s", row.name,
                     row.what, of, row.unit[0] == '1' && row.unit[1] == 0 ? "" : row.unit);
}

/// Each command with its numbers, for the schema.
SchemaKeyword forms() {
  std::vector<JsonValue> all;
  for (const ConsoleRow& row : console_rows) {
    std::vector<SchemaKeyword> keys = {{"do", json_object({{"const", json_text(row.name)}})}};
    const std::vector<double>* some = choices(row.command);
    JsonType number = some                    ? json_type::one_of_numbers(*some)
                      : is_whole(row.command) ? json_type::whole(from_to(row.least, row.most))
                                              : json_type::number(from_to(row.least, row.most));
    keys.emplace_back("values", json_object(json_type::list_of(number, row.values, row.values).schema));
    if (row.values == 0) keys.back().second = json_object({{"maxItems", json_number(0)}});
    std::vector<SchemaKeyword> form = {{"title", json_text(row.what)}, {"properties", json_object(std::move(keys))}};
    if (row.values > 0) form.emplace_back("required", json_list(std::vector<std::string>{"values"}));
    all.push_back(json_object(std::move(form)));
  }
  return {"oneOf", json_list(std::move(all))};
}

const JsonObjectKeys order_keys = {
    "order",
    {{"do", true, "a command of the console", json_type::choice(names())},
     {"values", false, "its numbers", json_type::list_of(json_type::number(), 0, most_console_values)}},
    {forms()}};

}  // namespace

const std::vector<const JsonObjectKeys*> console_keys_of_messages::all = {&order_keys};

const ConsoleRow* console_row(const std::string& name) {
  const auto* at = std::find_if(std::begin(console_rows), std::end(console_rows),
                                [&](const ConsoleRow& row) { return name == row.name; });
  return at == std::end(console_rows) ? nullptr : at;
}

ConsoleOrder read_console_order(const JsonValue& message) {
  const JsonObject object(message, order_keys);
  const ConsoleRow& row = console_rows[object.choice("do", names())];
  ConsoleOrder order{row.command, {}};
  const std::size_t count = object.has("values") ? object.list("values").size() : 0;
  const auto refuse = [&] { (object.has("values") ? object["values"] : object["do"]).refuse(expected_of(row)); };
  if (count != static_cast<std::size_t>(row.values)) refuse();
  for (std::size_t i = 0; i < count; ++i) {
    const JsonValue& value = object.list("values")[i];
    const double number = value.number;
    const std::vector<double>* some = choices(row.command);
    if (value.type != JsonValue::Type::number || !(number >= row.least && number <= row.most) ||
        (some && std::find(some->begin(), some->end(), number) == some->end()) ||
        (is_whole(row.command) && number != std::floor(number)))
      refuse();
    order.values[i] = number;
  }
  return order;
}

ConsoleOrder read_console_order(const std::string& from, const std::string& text) {
  return read_console_order(parse_json(from, text));
}

}  // namespace ostium::data
