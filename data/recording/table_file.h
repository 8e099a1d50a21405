#pragma once
/// Tables of numbers and texts in an HDF5 file that h5py, h5dump, MATLAB and others can read directly. The only code
/// that uses HDF5. A table is a data set of rows that can grow, each of some columns, which may be points (rows by
/// columns by 3); a number or a text is a data set of one. Attributes say what they are.
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace ostium::data {

enum class NumberType { float64, float32, uint64 };

/// What is said of a table or of the whole file.
struct TableAttribute {
  std::string name;
  std::variant<double, std::string, std::vector<double>, std::vector<std::string>> value;
};

struct TableLayout {
  std::string name;  ///< "inputs"; "shapes/wire" is in a group
  NumberType type = NumberType::float64;
  std::vector<std::string> columns;  ///< attribute "columns": name and unit of each; may be empty
  int width = 1;                     ///< numbers per row; columns.size() if there are columns
  int chunk_rows = 1;                ///< rows compressed together
  int depth = 1;                     ///< numbers per column; 3: points. A divisor of `width`
  std::vector<TableAttribute> attributes = {};
};

/// All errors name the file: LoadError what cannot be read, WriteError what cannot be written. Not for the simulation
/// thread. One file, one thread.
class TableFile {
 public:
  /// Creates the file, replacing an existing one.
  static TableFile create(const std::string& path);
  /// Opens an existing file; refuses one that is not HDF5, or is truncated.
  static TableFile open(const std::string& path, bool to_write = false);
  ~TableFile();
  TableFile(TableFile&&) noexcept;
  TableFile& operator=(TableFile&&) noexcept;

  void add_table(const TableLayout& layout);
  /// `count` rows of the table's type, row-major.
  void append(const std::string& table, const void* rows, std::size_t count);
  /// Cuts off all but the first rows.
  void shorten(const std::string& table, std::size_t rows);
  void remove(const std::string& name);  ///< does nothing if there is none
  /// Creates or replaces a text.
  void set_text(const std::string& name, const std::string& text);
  void set_number(const std::string& name, double number);  ///< creates it
  /// Of a table, or, if that is "", of the file. An empty list is left out; one of more than 4,000 texts is refused, as
  /// HDF5 keeps 64 KiB in an attribute.
  void set_attribute(const std::string& table, const TableAttribute& attribute);

  bool has(const std::string& name) const;
  std::size_t rows(const std::string& table) const;
  int width(const std::string& table) const;
  std::vector<std::string> columns(const std::string& table) const { return texts(table, "columns"); }
  /// An attribute that is a list of texts, of a table or, if that is "", of the file; empty: there is none.
  std::vector<std::string> texts(const std::string& table, const std::string& attribute) const;
  /// The names of such attributes.
  std::vector<std::string> lists_of_texts(const std::string& table) const;
  std::vector<double> numbers(const std::string& table, std::size_t first, std::size_t count) const;
  std::vector<std::uint64_t> integers(const std::string& table, std::size_t first, std::size_t count) const;
  std::string text(const std::string& name) const;
  double number(const std::string& name) const;

  /// Flushes and closes the file. Throws errors, which a destructor cannot.
  void close();

 private:
  struct Handle;
  explicit TableFile(std::unique_ptr<Handle> handle);
  std::unique_ptr<Handle> file_;
};

}  // namespace ostium::data
