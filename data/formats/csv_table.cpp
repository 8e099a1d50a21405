#include "data/formats/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "data/formats/decimal.h"
#include "data/formats/load_error.h"
#include "data/formats/read_file.h"

namespace ostium::data {

namespace {

std::string trimmed(const std::string& text) {
  const std::size_t from = text.find_first_not_of(" \r\t"), to = text.find_last_not_of(" \r\t");
  return from == std::string::npos ? "" : text.substr(from, to - from + 1);
}

std::vector<std::string> split_fields(const std::string& line, char separator) {
  std::vector<std::string> out = {""};
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      out.back() += line[i++];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == separator && !quoted)
      out.emplace_back();
    else
      out.back() += line[i];
  }
  for (std::string& field : out) field = trimmed(field);
  return out;
}

/// The rarest of those that a line has: names may hold commas, and lists of names no tabs.
char separator_in(const std::string& line) {
  for (const char one : {'\t', ';'})
    if (line.find(one) != std::string::npos) return one;
  return ',';
}

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

/// The file's text with \n at the end of every line, whichever its program writes.
std::string text_of(const std::string& file, const std::string& expected) {
  const std::string bytes = read_file(file, "a table with the columns " + expected);
  require_utf8(file, bytes);
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] == '\0')
      throw LoadError(fmt::format("{}:{}: holds a byte 0; expected text, UTF-8", file,
                                  1 + std::count(out.begin(), out.end(), '\n')));
    const bool ends = bytes[i] == '\r' && (i + 1 == bytes.size() || bytes[i + 1] != '\n');
    if (ends || bytes[i] != '\r') out += ends ? '\n' : bytes[i];
  }
  return out;
}

bool is_empty(const std::vector<std::string>& fields) {
  return std::all_of(fields.begin(), fields.end(), [](const std::string& field) { return field.empty(); });
}

/// Spreadsheets leave empty columns on the right.
void drop_empty_columns(CsvTable& table) {
  while (
      table.columns.size() > 1 && table.columns.back().empty() &&
      std::all_of(table.rows.begin(), table.rows.end(), [](const CsvRow& row) { return row.fields.back().empty(); })) {
    table.columns.pop_back();
    for (CsvRow& row : table.rows) row.fields.pop_back();
  }
}

}  // namespace

CsvTable load_csv(const std::string& file, const std::string& expected) {
  std::istringstream in(text_of(file, expected));
  CsvTable out;
  char separator = 0;  // until it is known
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    if (++number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    if (trimmed(line).empty() || line[0] == '#') continue;
    if (number == 1 && line.starts_with("sep=") && line.size() == 5) {  // as Excel writes and reads it
      separator = line[4];
      continue;
    }
    if (out.columns.empty()) {
      if (separator == 0) separator = separator_in(line);
      out.header_line = number, out.columns = split_fields(line, separator);
      if (std::all_of(out.columns.begin(), out.columns.end(), [](const auto& name) { return decimal(name); }))
        throw LoadError(fmt::format("{}:{}: the first line has no names; expected a header with the columns {}", file,
                                    number, expected));
      continue;
    }
    std::vector<std::string> fields_of_line = split_fields(line, separator);
    if (is_empty(fields_of_line)) continue;  // as spreadsheets leave them below
    out.rows.push_back({number, std::move(fields_of_line)});
    if (const std::size_t fields = out.rows.back().fields.size(); fields != out.columns.size())
      throw LoadError(
          fmt::format("{}:{}: {} fields; expected {}, as the header in line {} has; what stands above the "
                      "header, or is no part of the table, begins with #",
                      file, number, fields, out.columns.size(), out.header_line));
  }
  drop_empty_columns(out);
  if (out.columns.empty()) throw LoadError(file + " is empty; expected a header with the columns " + expected);
  return out;
}

std::vector<CsvRow> load_csv(const std::string& file, const std::vector<std::string>& columns) {
  CsvTable table = load_csv(file, listed(columns));
  std::vector<std::size_t> at;  // of each of `columns`, its place in a line
  for (const std::string& name : columns) {
    const auto found = std::find(table.columns.begin(), table.columns.end(), name);
    if (found == table.columns.end() || table.columns.size() != columns.size())
      throw LoadError(fmt::format("{}:{}: the header is {}; expected {}", file, table.header_line,
                                  listed(table.columns), listed(columns)));
    at.push_back(static_cast<std::size_t>(found - table.columns.begin()));
  }
  for (CsvRow& row : table.rows) {
    std::vector<std::string> fields;
    for (const std::size_t i : at) fields.push_back(row.fields[i]);
    row.fields = fields;
  }
  return table.rows;
}

std::string doubt_of_end(const std::string& file) {
  const std::string text = text_of(file, "of numbers");
  if (text.empty() || text.back() == '\n') return "";
  return fmt::format(
      "{}:{}: the last line has no end: its last number may have been cut; if it is whole, end the line.", file,
      1 + std::count(text.begin(), text.end(), '\n'));
}

double csv_number(const std::string& file, const CsvRow& row, const std::string& column, const std::string& field) {
  if (const std::optional<double> value = decimal(field)) return *value;
  throw LoadError(fmt::format("{}:{}: {} is \"{}\"; expected a number, with a point before its decimals", file,
                              row.line, column, field));
}

}  // namespace ostium::data
