#pragma once
/// Recordings of runs in a tube, and copies of them in which something was changed.
#include <unistd.h>

#include <filesystem>
#include <functional>

#include "app/session/run/play.h"
#include "tests/app/session/tube_vessel.h"

namespace ostium::app {

namespace fs = std::filesystem;

/// A temporary folder, removed at the end.
struct Folder {
  Folder() : path(fs::temp_directory_path() / ("ostium-" + std::to_string(getpid()))) { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  std::string operator()(const char* name) const { return (path / name).string(); }
  fs::path path;
};

inline PlayReport recorded(const std::string& file, RecordMode mode, const RunSetup& setup = tube_setup(),
                           double shapes_Hz = 0) {
  ScriptedRun run(setup, tube_vessel());
  PlayOptions options;
  options.recorder = {mode, file, true, shapes_Hz};
  return play(run, setup, options);
}

/// A copy of a recording in which `change` was done to the numbers of one of its tables; of version 2 if asked for.
inline void copy_with(const std::string& from, const std::string& to, const std::string& changed,
                      const std::function<void(std::vector<double>&)>& change, bool version_2 = false) {
  const data::TableFile file = data::TableFile::open(from);
  data::TableFile copy = data::TableFile::create(to);
  for (const char* text : {"software", "setup", "end"}) copy.set_text(text, file.text(text));
  copy.set_text("schema", version_2 ? "ostium-recording/2" : file.text("schema"));
  if (version_2)
    copy.set_text("step_s", "0.001");
  else
    copy.set_number("step_s", file.number("step_s"));
  for (const std::string table :
       {"inputs", "hash", "signals", "events", "state", "hands", "mesh_vertices", "mesh_triangles"}) {
    const bool whole = table == "hash" || table == "mesh_triangles", single = table == "signals";
    copy.add_table({table,
                    whole    ? data::NumberType::uint64
                    : single ? data::NumberType::float32
                             : data::NumberType::float64,
                    file.columns(table), file.width(table), 64});
    const std::size_t rows = file.rows(table);
    if (whole) {
      copy.append(table, file.integers(table, 0, rows).data(), rows);
      continue;
    }
    std::vector<double> numbers = file.numbers(table, 0, rows);
    if (table == changed) change(numbers);
    const std::vector<float> singles(numbers.begin(), numbers.end());
    copy.append(table, single ? static_cast<const void*>(singles.data()) : numbers.data(), rows);
  }
  copy.close();
}

}  // namespace ostium::app
