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

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

}  // namespace

CsvTable load_csv(const std::string& file, const std::string& expected) {
  std::istringstream in(read_file(file, "a table with the columns " + expected));
  CsvTable out;
  char separator = ',';
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    if (++number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    if (trimmed(line).empty() || line[0] == '#') continue;
    if (out.columns.empty()) {
      for (const char other : {';', '\t'})
        if (line.find(other) != std::string::npos) separator = other;
      out.header_line = number, out.columns = split_fields(line, separator);
      continue;
    }
    out.rows.push_back({number, split_fields(line, separator)});
    if (const std::size_t fields = out.rows.back().fields.size(); fields != out.columns.size())
      throw LoadError(
          fmt::format("{}:{}: {} fields; expected {}, as the header has", file, number, fields, out.columns.size()));
  }
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

double csv_number(const std::string& file, const CsvRow& row, const std::string& column, const std::string& field) {
  if (const std::optional<double> value = decimal(field)) return *value;
  throw LoadError(fmt::format("{}:{}: {} is \"{}\"; expected a number, with a point before its decimals", file,
                              row.line, column, field));
}

}  // namespace ostium::data
