#include "data/recording/table_file.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "data/formats/load_error.h"
#include "data/formats/read_file.h"
#include "data/formats/write_file.h"

namespace ostium::data {

namespace {

/// Owns an HDF5 identifier and closes it.
class Id {
 public:
  using Close = herr_t (*)(hid_t);
  Id(hid_t id, Close close) : id_(id), close_(close) {}
  ~Id() {
    if (id_ >= 0) close_(id_);
  }
  Id(const Id&) = delete;
  Id& operator=(const Id&) = delete;
  operator hid_t() const { return id_; }
  bool ok() const { return id_ >= 0; }

 private:
  hid_t id_;
  Close close_;
};

hid_t in_file(NumberType type) {
  return type == NumberType::float64 ? H5T_IEEE_F64LE : type == NumberType::float32 ? H5T_IEEE_F32LE : H5T_STD_U64LE;
}

/// HDF5's innermost error message.
std::string last_words() {
  std::string words;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned n, const H5E_error2_t* error, void* out) -> herr_t {
        if (n == 0 && error->desc) *static_cast<std::string*>(out) = error->desc;
        return 0;
      },
      &words);
  return words;
}

/// We report errors ourselves and close all files ourselves: the library must not try at exit to write a file left open
/// after a full disk (version 1.10 then reads freed memory).
void begin() {
  [[maybe_unused]] static const herr_t no_cleaning_up = H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// No file locking: reading a recording while it is being written must not stop the writer. HDF5 opens a file again in
/// one process only with the same two flags; these are those of h5py's locking=False.
hid_t unlocked() {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_file_locking(access, false, false);
  return access;
}

/// Beyond these a file is damaged: a day's steps; a state's numbers a hundred times over; a text.
constexpr hsize_t most_rows = 100'000'000, most_columns = 10'000'000;
constexpr std::size_t longest_text = 256 << 20, most_names = 10'000;
constexpr hsize_t most_texts = 4'000;  // of an attribute that we write

hid_t text_type(std::size_t length) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, length);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

}  // namespace

namespace {

struct Extent {
  int rank = 2;
  hsize_t sizes[3] = {0, 1, 1};
  hsize_t rows() const { return sizes[0]; }
  hsize_t width() const { return sizes[1] * sizes[2]; }
};

}  // namespace

struct TableFile::Handle {
  std::string path;
  hid_t id = -1;
  ~Handle() {
    if (id >= 0) H5Fclose(id);
  }
  std::string complaint(const std::string& what) const {
    const std::string words = last_words();
    return fmt::format("{}: {}{}", path, what, words.empty() ? "" : " (" + words + ")");
  }
  void require(bool ok, const std::string& what) const {
    if (!ok) throw LoadError(complaint(what));
  }
  void require_written(bool ok, const std::string& what) const {
    if (!ok) throw WriteError(path + ": " + what + "; is the disk full?");  // HDF5's own words are of its inside
  }
  hid_t table(const std::string& name) const {
    const hid_t set = H5Dopen2(id, name.c_str(), H5P_DEFAULT);
    require(set >= 0, "has no table \"" + name + "\"");
    return set;
  }
  hid_t object(const std::string& name) const {
    const hid_t found = H5Oopen(id, name.empty() ? "/" : name.c_str(), H5P_DEFAULT);
    require(found >= 0, "has no table \"" + name + "\"");
    return found;
  }
  /// Rows, columns, and numbers per column.
  Extent extent(hid_t set) const {
    const Id space(H5Dget_space(set), H5Sclose);
    const int rank = space.ok() ? H5Sget_simple_extent_ndims(space) : -1;
    Extent out;
    require((rank == 2 || rank == 3) && H5Sget_simple_extent_dims(space, out.sizes, nullptr) == rank,
            "has a table that is not rows by columns");
    out.rank = rank;
    const hsize_t columns = out.sizes[1], depth = out.sizes[2];
    require(out.sizes[0] <= most_rows && columns >= 1 && columns <= most_columns && depth >= 1 &&
                depth <= most_columns && columns * depth <= most_columns,
            fmt::format("has a table of {} rows by {} columns; it is damaged", out.sizes[0], columns));
    return out;
  }
  void read(const std::string& name, std::size_t first, std::size_t count, hid_t type, void* out) const {
    const Id set(table(name), H5Dclose);
    const Extent whole = extent(set);
    require(first + count <= whole.rows(),
            fmt::format("table {} has {} rows; {} were wanted", name, whole.rows(), first + count));
    if (count == 0) return;
    const hsize_t start[3] = {first, 0, 0}, size[3] = {count, whole.sizes[1], whole.sizes[2]};
    const Id space(H5Dget_space(set), H5Sclose), memory(H5Screate_simple(whole.rank, size, nullptr), H5Sclose);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, size, nullptr);
    require(H5Dread(set, type, memory, space, H5P_DEFAULT, out) >= 0,
            "table " + name + " is damaged; copy the file again");
  }
};

TableFile::TableFile(std::unique_ptr<Handle> handle) : file_(std::move(handle)) {}
TableFile::~TableFile() = default;
TableFile::TableFile(TableFile&&) noexcept = default;
TableFile& TableFile::operator=(TableFile&&) noexcept = default;

TableFile TableFile::create(const std::string& path) {
  begin();
  auto handle = std::make_unique<Handle>();
  handle->path = path;
  handle->id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, Id(unlocked(), H5Pclose));
  if (handle->id < 0) throw write_error(path, last_words());
  return TableFile(std::move(handle));
}

TableFile TableFile::open(const std::string& path, bool to_write) {
  begin();
  auto handle = std::make_unique<Handle>();
  handle->path = path;
  require_file(path, "a recording, as run.h5 in a folder of `ostium run --out`");
  const htri_t hdf5 = H5Fis_hdf5(path.c_str());
  if (hdf5 == 0) throw LoadError(path + ": is no HDF5 file; expected a recording of `ostium run`");
  handle->id = H5Fopen(path.c_str(), to_write ? H5F_ACC_RDWR : H5F_ACC_RDONLY, Id(unlocked(), H5Pclose));
  handle->require(handle->id >= 0, "is an HDF5 file that cannot be opened: cut short, or damaged");
  return TableFile(std::move(handle));
}

void TableFile::close() {
  if (file_->id < 0) return;
  const hid_t id = std::exchange(file_->id, -1);
  const bool flushed = H5Fflush(id, H5F_SCOPE_LOCAL) >= 0;
  const bool closed = H5Fclose(id) >= 0;
  file_->require_written(flushed && closed, "cannot be written to its end");
}

void TableFile::add_table(const TableLayout& layout) {
  const int rank = layout.depth > 1 ? 3 : 2;
  const auto depth = static_cast<hsize_t>(layout.depth), columns = static_cast<hsize_t>(layout.width) / depth;
  const hsize_t now[3] = {0, columns, depth}, most[3] = {H5S_UNLIMITED, columns, depth},
                chunk[3] = {static_cast<hsize_t>(layout.chunk_rows), columns, depth};
  const Id space(H5Screate_simple(rank, now, most), H5Sclose);
  const Id how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose), link(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(link, 1);
  H5Pset_chunk(how, rank, chunk);
  H5Pset_shuffle(how);
  H5Pset_deflate(how, 1);
  {
    const Id set(H5Dcreate2(file_->id, layout.name.c_str(), in_file(layout.type), space, link, how, H5P_DEFAULT),
                 H5Dclose);
    file_->require_written(set.ok(), "table " + layout.name + " cannot be made");
  }
  set_attribute(layout.name, {"columns", layout.columns});
  for (const TableAttribute& attribute : layout.attributes) set_attribute(layout.name, attribute);
}

void TableFile::set_attribute(const std::string& table, const TableAttribute& attribute) {
  const auto& value = attribute.value;
  const auto* const number = std::get_if<double>(&value);
  const auto* const numbers = std::get_if<std::vector<double>>(&value);
  const auto* const text = std::get_if<std::string>(&value);
  const auto* const texts = std::get_if<std::vector<std::string>>(&value);
  const hsize_t count = numbers ? numbers->size() : texts ? texts->size() : 1;
  if (count == 0) return;
  if (texts && count > most_texts)
    throw WriteError(
        fmt::format("{}: {} has {} texts; {} are kept at most", file_->path, attribute.name, count, most_texts));
  std::vector<const char*> pointers;
  if (text) pointers.push_back(text->c_str());
  if (texts)
    for (const std::string& one : *texts) pointers.push_back(one.c_str());
  const Id object(file_->object(table), H5Oclose);
  const Id space(number || text ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Id type(pointers.empty() ? H5Tcopy(H5T_IEEE_F64LE) : H5Tcopy(H5T_C_S1), H5Tclose);
  if (!pointers.empty()) H5Tset_size(type, H5T_VARIABLE), H5Tset_cset(type, H5T_CSET_UTF8);
  const Id made(H5Acreate2(object, attribute.name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const void* const bytes = number    ? static_cast<const void*>(number)
                            : numbers ? static_cast<const void*>(numbers->data())
                                      : static_cast<const void*>(pointers.data());
  file_->require_written(made.ok() && H5Awrite(made, pointers.empty() ? H5T_NATIVE_DOUBLE : hid_t(type), bytes) >= 0,
                         fmt::format("\"{}\" of table {} cannot be written", attribute.name, table));
}

void TableFile::append(const std::string& name, const void* rows, std::size_t count) {
  if (count == 0) return;
  const Id set(file_->table(name), H5Dclose);
  const Extent before = file_->extent(set);
  const hsize_t columns = before.sizes[1], depth = before.sizes[2];
  const hsize_t start[3] = {before.rows(), 0, 0}, size[3] = {count, columns, depth},
                whole[3] = {before.rows() + count, columns, depth};
  file_->require_written(H5Dset_extent(set, whole) >= 0, "table " + name + " cannot grow");
  const Id space(H5Dget_space(set), H5Sclose), memory(H5Screate_simple(before.rank, size, nullptr), H5Sclose);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, size, nullptr);
  const Id type(H5Dget_type(set), H5Tclose), native(H5Tget_native_type(type, H5T_DIR_ASCEND), H5Tclose);
  // Rows wait in a cache, and what fails as it is emptied on closing the table is told to nobody.
  file_->require_written(H5Dwrite(set, native, memory, space, H5P_DEFAULT, rows) >= 0 && H5Dflush(set) >= 0,
                         "table " + name + " cannot be written");
}

void TableFile::shorten(const std::string& name, std::size_t rows) {
  const Id set(file_->table(name), H5Dclose);
  const Extent before = file_->extent(set);
  const hsize_t whole[3] = {std::min<hsize_t>(rows, before.rows()), before.sizes[1], before.sizes[2]};
  file_->require_written(H5Dset_extent(set, whole) >= 0 && H5Dflush(set) >= 0,
                         "table " + name + " cannot be cut short");
}

void TableFile::remove(const std::string& name) {
  if (has(name))
    file_->require_written(H5Ldelete(file_->id, name.c_str(), H5P_DEFAULT) >= 0, name + " cannot be removed");
}

void TableFile::set_number(const std::string& name, double number) {
  const Id space(H5Screate(H5S_SCALAR), H5Sclose);
  const Id set(H5Dcreate2(file_->id, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
               H5Dclose);
  file_->require_written(set.ok() && H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &number) >= 0,
                         name + " cannot be written");
}

void TableFile::set_text(const std::string& name, const std::string& text) {
  remove(name);
  const Id type(text_type(std::max<std::size_t>(1, text.size())), H5Tclose);
  const Id space(H5Screate(H5S_SCALAR), H5Sclose);
  const Id set(H5Dcreate2(file_->id, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  file_->require_written(
      set.ok() && H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.empty() ? "" : text.data()) >= 0,
      name + " cannot be written");
}

bool TableFile::has(const std::string& name) const { return H5Lexists(file_->id, name.c_str(), H5P_DEFAULT) > 0; }

std::size_t TableFile::rows(const std::string& name) const {
  const Id set(file_->table(name), H5Dclose);
  return file_->extent(set).rows();
}

int TableFile::width(const std::string& name) const {
  const Id set(file_->table(name), H5Dclose);
  return static_cast<int>(file_->extent(set).width());
}

std::vector<std::string> TableFile::texts(const std::string& table, const std::string& attribute) const {
  const Id object(file_->object(table), H5Oclose);
  if (H5Aexists(object, attribute.c_str()) <= 0) return {};
  const std::string what = fmt::format("\"{}\" of table \"{}\"", attribute, table);
  const Id names(H5Aopen(object, attribute.c_str(), H5P_DEFAULT), H5Aclose);
  const Id space(H5Aget_space(names), H5Sclose), type(H5Aget_type(names), H5Tclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  file_->require(count >= 0 && static_cast<std::size_t>(count) <= most_names && H5Tis_variable_str(type) > 0,
                 what + " is no list of texts");
  std::vector<char*> pointers(static_cast<std::size_t>(count), nullptr);
  file_->require(H5Aread(names, type, pointers.data()) >= 0, what + " is damaged; copy the file again");
  std::vector<std::string> out;
  out.reserve(pointers.size());
  for (const char* p : pointers) out.emplace_back(p ? p : "");
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
  return out;
}

std::vector<std::string> TableFile::lists_of_texts(const std::string& table) const {
  const Id object(file_->object(table), H5Oclose);
  H5O_info_t about;
  file_->require(H5Oget_info2(object, &about, H5O_INFO_NUM_ATTRS) >= 0, "is damaged; copy the file again");
  std::vector<std::string> out;
  for (hsize_t k = 0; k < about.num_attrs; ++k) {
    const Id attribute(H5Aopen_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, k, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const Id type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
    if (H5Tis_variable_str(type) <= 0 || H5Sget_simple_extent_type(space) != H5S_SIMPLE) continue;
    std::string name(static_cast<std::size_t>(std::max<ssize_t>(0, H5Aget_name(attribute, 0, nullptr))), '\0');
    H5Aget_name(attribute, name.size() + 1, name.data());
    out.push_back(std::move(name));
  }
  return out;
}

std::vector<double> TableFile::numbers(const std::string& table, std::size_t first, std::size_t count) const {
  std::vector<double> out(count * static_cast<std::size_t>(width(table)));
  file_->read(table, first, count, H5T_NATIVE_DOUBLE, out.data());
  return out;
}

std::vector<std::uint64_t> TableFile::integers(const std::string& table, std::size_t first, std::size_t count) const {
  std::vector<std::uint64_t> out(count * static_cast<std::size_t>(width(table)));
  file_->read(table, first, count, H5T_NATIVE_UINT64, out.data());
  return out;
}

double TableFile::number(const std::string& name) const {
  const Id set(file_->table(name), H5Dclose), space(H5Dget_space(set), H5Sclose), type(H5Dget_type(set), H5Tclose);
  double number = 0;
  file_->require(H5Tget_class(type) == H5T_FLOAT && H5Sget_simple_extent_npoints(space) == 1 &&
                     H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &number) >= 0,
                 "\"" + name + "\" is no number");
  return number;
}

std::string TableFile::text(const std::string& name) const {
  file_->require(has(name), "has no \"" + name + "\"");
  const Id set(H5Dopen2(file_->id, name.c_str(), H5P_DEFAULT), H5Dclose);
  const Id type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
  file_->require(set.ok() && H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0 &&
                     H5Sget_simple_extent_npoints(space) == 1 && H5Tget_size(type) <= longest_text,
                 "\"" + name + "\" is no text");
  std::string text(H5Tget_size(type), '\0');
  file_->require(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) >= 0,
                 "\"" + name + "\" is damaged; copy the file again");
  while (!text.empty() && text.back() == '\0') text.pop_back();
  return text;
}

}  // namespace ostium::data
