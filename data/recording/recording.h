#pragma once
/// A recording: every input of a run, its results, and enough state to resume from any second. HDF5; the contents are
/// described in data/recording/README.md.
///
/// Writing survives a crash of the program at any moment, and a full disk, by alternating two files: one is complete
/// and closed under the recording's name, while the other, NAME.next, is opened, brought up to date, closed and renamed
/// to take its place.
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/recording/table_file.h"

namespace ostium::data {

/// Version 1 had the flags and indices of state in another layout. Version 2 had no shapes and no names, and a text for
/// the step; it is read.
inline constexpr int recording_version = 3, oldest_recording_version = 2;
/// Steps written together. With the time to write them, a kill loses at most half a second.
inline constexpr int steps_per_block = 200;
inline constexpr int steps_per_signal = 10;
inline constexpr int steps_per_state = 1000;

/// The results of a block of steps. Rows are laid out like the tables.
struct RecordingBlock {
  std::vector<double> inputs;         ///< one row per step
  std::vector<std::uint64_t> hashes;  ///< one per step, of the state after it
  std::vector<float> signals;         ///< one row per steps_per_signal steps
  std::vector<double> states;         ///< one row per steps_per_state steps, including the start
  std::vector<double> hands;          ///< one row per state: the script operator's memory
  std::vector<double> events;         ///< step, code, tool, value
  // One row per moment at which shapes are recorded:
  std::vector<std::uint64_t> shape_steps;    ///< its step
  std::vector<double> shape_inserted_m;      ///< of each tool, length in the body
  std::vector<std::vector<float>> shapes_m;  ///< of each tool, its nodes; NaN: not in the body
};

/// A tool whose nodes are recorded.
struct RecordedShape {
  std::string tool;
  std::vector<double> from_tip_m;  ///< of each node, along the unloaded tool, from the base on: falling to 0
};

struct RecordingHeader {
  std::string software;  ///< program that wrote it: "ostium 0.1.0"
  std::string setup;     ///< JSON: case, script, instruments, seed
  double step_s = 1e-3;
  bool full = true;  ///< whether states are kept
  std::vector<std::string> input_columns, signal_columns;
  int state_width = 1, operator_width = 1;
  // What numbers stand for. May be empty:
  std::vector<std::string> input_units = {}, signal_units = {}, signal_definitions = {};  ///< of each column
  std::vector<std::string> tools = {}, branches = {}, script_steps = {};  ///< by index, as events and signals have it
  std::string frame = "";                                                 ///< of positions
  std::vector<TableAttribute> of_events = {};                             ///< what codes stand for
  int steps_per_shape = 0;                                                ///< 0: no shapes
  std::vector<RecordedShape> shapes = {};                                 ///< one per tool
};

/// A table that does not grow during the run: a mesh.
struct FixedTable {
  TableLayout layout;
  const void* rows = nullptr;  ///< of the layout's type
  std::size_t count = 0;
};

class RecordingWriter {
 public:
  using FileId = std::pair<std::uint64_t, std::uint64_t>;  ///< device and number of a file, whatever its name
  /// Creates both files. Throws WriteError, and leaves neither; what was there is then as it was.
  RecordingWriter(std::string path, const RecordingHeader& header, const std::vector<FixedTable>& tables = {});
  /// Goes on after the first `steps` of another recording of the same run, a multiple of steps_per_state. That one is
  /// left as it is. Throws LoadError if it is not of this header's layout, or shorter.
  RecordingWriter(std::string path, const RecordingHeader& header, const std::string& from, std::size_t steps);
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;
  /// Removes the other file; the recording stays as last committed.
  ~RecordingWriter() = default;
  /// Throws WriteError; the recording then stays as it was.
  void commit(RecordingBlock block);
  /// Writes the end of the run: outcome, reason, metrics, as JSON. Removes the other file.
  void finish(const std::string& end);

 private:
  void write(TableFile& file, const RecordingBlock& block) const;
  void write_both(const std::function<void(const std::string& path)>& write);
  void take_turns() const;
  TableFile open_next() const;

  /// A file's second name, removed at the end.
  struct Beside {
    std::string path;
    const std::array<FileId, 2>& own;
    ~Beside();
  };
  std::string path_;
  std::array<FileId, 2> own_;  ///< of the two files, which exchange their names
  Beside next_, before_;       ///< the other file; one that is about to be renamed
  RecordingHeader header_;
  RecordingBlock last_;  ///< in the recording, but not yet in the other file
};

class RecordingReader {
 public:
  /// Throws LoadError saying what the file is if it is not a recording of this version.
  explicit RecordingReader(const std::string& path);

  const std::string& path() const { return path_; }
  std::string software() const { return file_.text("software"); }
  std::string setup() const { return file_.text("setup"); }
  double step_s() const;
  std::optional<std::string> end() const;  ///< empty: the recording was cut off
  std::size_t steps() const { return file_.rows("hash"); }
  std::size_t states() const { return file_.has("state") ? file_.rows("state") : 0; }
  int state_width() const { return file_.width("state"); }
  std::vector<std::string> input_columns() const { return file_.columns("inputs"); }
  std::vector<std::string> signal_columns() const { return file_.columns("signals"); }
  /// Throws LoadError if one is no finite number, which no step can be made of.
  std::vector<double> inputs(std::size_t first, std::size_t count) const;
  std::vector<std::uint64_t> hashes(std::size_t first, std::size_t count) const {
    return file_.integers("hash", first, count);
  }
  std::vector<double> state(std::size_t second) const { return file_.numbers("state", second, 1); }
  std::vector<double> signals() const { return file_.numbers("signals", 0, file_.rows("signals")); }
  std::vector<double> events() const { return file_.numbers("events", 0, file_.rows("events")); }
  std::vector<std::string> tools() const { return file_.texts("", "tools"); }  ///< empty in version 2
  const TableFile& tables() const { return file_; }

 private:
  void require_version();
  void require_layout() const;

  std::string path_;
  TableFile file_;
  int version_ = recording_version;
};

/// The table of a tool's nodes: "shapes/wire".
std::string shape_table(const std::string& tool);

/// The unit that a column's name ends with, as it is written elsewhere: "m/s" of "wire.advance_m_s"; "1" if none.
std::string unit_in_name(const std::string& column);

/// Reads all of a recording once, in pieces, and keeps nothing. Throws LoadError if anything in it cannot be read.
void read_to_end(const std::string& path);

}  // namespace ostium::data
