#pragma once
/// Tables of numbers and texts in an HDF5 file, which h5py, h5dump, MATLAB and the like read as they are. The only
/// place that knows HDF5. A table is a two-dimensional data set, rows by columns, that grows; a text is a data set of
/// one string.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ostium::data {

enum class NumberType { float64, float32, uint64 };

struct TableLayout {
  std::string name;  ///< "inputs"
  NumberType type = NumberType::float64;
  std::vector<std::string> columns;  ///< attribute "columns": name and unit of each; may be empty
  int width = 1;                     ///< numbers a row; columns.size() if there are columns
  int chunk_rows = 1;                ///< rows that are compressed together
};

/// Any trouble throws LoadError that names the file. Not for the thread that steps. One file, one thread.
class TableFile {
 public:
  /// Makes the file anew.
  static TableFile create(const std::string& path);
  /// Opens one that there is; refuses what is no HDF5 file, or is shorter than it says.
  static TableFile open(const std::string& path, bool to_write = false);
  ~TableFile();
  TableFile(TableFile&&) noexcept;
  TableFile& operator=(TableFile&&) noexcept;

  void add_table(const TableLayout& layout);
  /// `count` rows of the table's own type, row by row.
  void append(const std::string& table, const void* rows, std::size_t count);
  /// Sets or replaces.
  void set_text(const std::string& name, const std::string& text);

  bool has(const std::string& name) const;
  std::size_t rows(const std::string& table) const;
  int width(const std::string& table) const;
  std::vector<std::string> columns(const std::string& table) const;
  std::vector<double> numbers(const std::string& table, std::size_t first, std::size_t count) const;
  std::vector<std::uint64_t> integers(const std::string& table, std::size_t first, std::size_t count) const;
  std::string text(const std::string& name) const;

  /// Everything to the file and shut. Errors are thrown, which a destructor cannot.
  void close();

 private:
  struct Handle;
  explicit TableFile(std::unique_ptr<Handle> handle);
  std::unique_ptr<Handle> file_;
};

}  // namespace ostium::data
