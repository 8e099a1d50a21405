#pragma once
/// Tables of a few named columns, as programs and spreadsheets write them: fields separated by commas, semicolons or
/// tabs (whichever the header has), quoted where they hold one (RFC 4180). Lines that begin with # are comments.
#include <string>
#include <vector>

namespace ostium::data {

struct CsvRow {
  int line = 0;                     ///< in the file, from 1
  std::vector<std::string> fields;  ///< in the order of the columns that were asked for
};

struct CsvTable {
  int header_line = 0;               ///< from 1
  std::vector<std::string> columns;  ///< as the header names them
  std::vector<CsvRow> rows;          ///< below it, as many fields each
};

/// A table whose header names its columns. Throws LoadError with file and line; `expected` says of what, for messages.
CsvTable load_csv(const std::string& file, const std::string& expected);

/// The rows below the header, which names `columns` in any order, and no others. Throws LoadError with file and line.
std::vector<CsvRow> load_csv(const std::string& file, const std::vector<std::string>& columns);

/// A word of doubt about a table whose last line has no end: cut within a number, it would still be read. Else empty.
std::string doubt_of_end(const std::string& file);

/// A field as a finite number, or LoadError with file, line and column.
double csv_number(const std::string& file, const CsvRow& row, const std::string& column, const std::string& field);

}  // namespace ostium::data
