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

std::string expected_of(const ConsoleRow& row) {
  const int count = row.count();
  if (count == 0) return fmt::format("no values, as \"{}\" has none", row.name);
  std::string of;
  for (int i = 0; i < count; ++i) {
    const ConsoleValue& value = row.values[static_cast<std::size_t>(i)];
    of += fmt::format("{}{}: ", i > 0 ? ", " : "", value.name);
    if (const std::vector<double>* some = choices(row.command))
      of += fmt::format("one of {:g}", fmt::join(*some, " "));
    else
      of += fmt::format("{:g} to {:g}", value.least, value.most);
    if (std::string(value.unit) != "1") of += fmt::format(" {}", value.unit);
  }
  return fmt::format("{} number{} for \"{}\" ({}); {}", count, count == 1 ? "" : "s", row.name, row.what, of);
}

/// Of value `i` of a command.
JsonType type_of(const ConsoleRow& row, int i) {
  const ConsoleValue& value = row.values[static_cast<std::size_t>(i)];
  if (const std::vector<double>* some = choices(row.command)) return json_type::one_of_numbers(*some);
  return value.whole ? json_type::whole(from_to(value.least, value.most))
                     : json_type::number(from_to(value.least, value.most));
}

/// The list of a command's values; those of one kind are told once.
JsonValue values_schema(const ConsoleRow& row) {
  const int count = row.count();
  if (count == 0) return json_object({{"maxItems", json_number(0)}});
  bool alike = true;
  for (int i = 1; i < count; ++i) {
    const ConsoleValue &a = row.values[0], &b = row.values[static_cast<std::size_t>(i)];
    alike = alike && a.least == b.least && a.most == b.most && a.whole == b.whole;
  }
  if (alike) return json_object(json_type::list_of(type_of(row, 0), count, count).schema);
  std::vector<JsonValue> each;
  for (int i = 0; i < count; ++i) each.push_back(json_object(type_of(row, i).schema));
  return json_object({{"type", json_text("array")},
                      {"prefixItems", json_list(std::move(each))},
                      {"minItems", json_number(count)},
                      {"maxItems", json_number(count)}});
}

/// Each command with its numbers, for the schema.
JsonMember forms() {
  std::vector<JsonValue> all;
  for (const ConsoleRow& row : console_rows) {
    std::vector<JsonMember> keys = {{"do", json_object({{"const", json_text(row.name)}})}};
    keys.emplace_back("values", values_schema(row));
    std::vector<JsonMember> form = {{"title", json_text(row.what)}, {"properties", json_object(std::move(keys))}};
    if (row.count() > 0) form.emplace_back("required", json_list(std::vector<std::string>{"values"}));
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
  if (count != static_cast<std::size_t>(row.count())) refuse();
  for (std::size_t i = 0; i < count; ++i) {
    const JsonValue& value = object.list("values")[i];
    const double number = value.number;
    const ConsoleValue& expected = row.values[i];
    const std::vector<double>* some = choices(row.command);
    if (value.type != JsonValue::Type::number || !(number >= expected.least && number <= expected.most) ||
        (some && std::find(some->begin(), some->end(), number) == some->end()) ||
        (expected.whole && number != std::floor(number)))
      refuse();
    order.values[i] = number;
  }
  return order;
}

ConsoleOrder read_console_order(const std::string& from, const std::string& text) {
  return read_console_order(parse_json(from, text));
}

}  // namespace ostium::data
