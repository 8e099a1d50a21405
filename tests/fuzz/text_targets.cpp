#include <fmt/format.h>

#include <cmath>

#include "data/formats/csv.h"
#include "data/formats/decimal.h"
#include "tests/fuzz/target.h"

namespace ostium::fuzz {

namespace {

std::vector<Seed> numbers() {
  std::vector<Seed> all;
  for (const char* text : {"0", "-2.5", "1e-3", "+7", "18446744073709551615", "4.9e-324", "1.7976931348623157e308"})
    all.push_back({"number", text});
  return all;
}

/// What is taken is finite, and its shortest text is read as the same number.
Answer read_number(const Seed& input) {
  const auto number = data::decimal(input.bytes);
  const auto whole = data::whole(input.bytes);
  if (number)
    require(std::isfinite(*number) && data::decimal(fmt::format("{}", *number)) == number, "a number is itself");
  if (whole) require(data::whole(std::to_string(*whole)) == whole && number, "a whole number is a number");
  return number || whole ? Answer::taken : Answer::refused;
}

std::vector<Seed> cells() {
  return {{"cell", "plain"}, {"cell", "a, \"b\"\r\nc"}, {"cell", "=1+2"}, {"cell", "-3"}, {"cell", "\"@x"}};
}

/// The text in a field, as RFC 4180 has it.
std::string unquoted(const std::string& field) {
  if (!field.starts_with('"')) return field;
  std::string text;
  for (std::size_t i = 1; i + 1 < field.size(); ++i) {
    if (field[i] == '"') require(field[++i] == '"' && i + 1 < field.size(), "quotes within a field are doubled");
    text += field[i];
  }
  return text;
}

/// A field brings its text back, and no spreadsheet takes it for a formula.
Answer write_cell(const Seed& input) {
  const std::string field = data::csv_field(input.bytes), text = unquoted(field);
  require(text == input.bytes || text == "'" + input.bytes, "a field holds its text");
  require(text.empty() || std::string("=+-@").find(text[0]) == std::string::npos, "a field is no formula");
  require(field.starts_with('"') || field.find_first_of(",\"\r\n") == std::string::npos, "a field is one field");
  return Answer::taken;
}

}  // namespace

std::vector<Target> text_targets() { return {{"number", numbers, read_number}, {"csv", cells, write_cell}}; }

}  // namespace ostium::fuzz
