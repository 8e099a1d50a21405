#include "data/recording/recording.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <utility>

#include "data/formats/decimal.h"
#include "data/formats/load_error.h"
#include "data/formats/paths.h"
#include "data/formats/write_file.h"

namespace ostium::data {

namespace {

const std::string schema = "ostium-recording/";

TableAttribute every(int steps) { return {"steps_per_row", static_cast<double>(steps)}; }

std::vector<TableLayout> shape_layouts(const RecordingHeader& h) {
  if (h.steps_per_shape == 0 || h.shapes.empty()) return {};
  const int rows = std::max(1, steps_per_block / h.steps_per_shape);
  const auto count = static_cast<int>(h.shapes.size());
  std::vector<TableLayout> all = {
      {"shapes_step", NumberType::uint64, {}, 1, rows, 1, {every(h.steps_per_shape)}},
      {"shapes_inserted", NumberType::float64, h.tools, count, rows, 1, {{"unit", std::string("m")}}}};
  for (const RecordedShape& shape : h.shapes)
    all.push_back({shape_table(shape.tool),
                   NumberType::float32,
                   {},
                   3 * static_cast<int>(shape.from_tip_m.size()),
                   rows,
                   3,
                   {{"tool", shape.tool},
                    {"from_tip_m", shape.from_tip_m},
                    {"unit", std::string("m")},
                    {"frame", h.frame},
                    every(h.steps_per_shape)}});
  return all;
}

std::vector<TableLayout> layouts(const RecordingHeader& h) {
  const auto width = [](const std::vector<std::string>& columns) { return static_cast<int>(columns.size()); };
  std::vector<TableLayout> all = {
      {"inputs",
       NumberType::float64,
       h.input_columns,
       width(h.input_columns),
       steps_per_block,
       1,
       {{"units", h.input_units}, every(1)}},
      {"hash", NumberType::uint64, {}, 1, steps_per_block, 1, {every(1)}},
      {"signals",
       NumberType::float32,
       h.signal_columns,
       width(h.signal_columns),
       steps_per_block / steps_per_signal,
       1,
       {{"units", h.signal_units}, {"definitions", h.signal_definitions}, every(steps_per_signal)}},
      {"events", NumberType::float64, {"step", "code", "tool", "value"}, 4, 256, 1, h.of_events}};
  if (h.full) {
    all.push_back({"state", NumberType::float64, {}, h.state_width, 1, 1, {every(steps_per_state)}});
    all.push_back({"hands", NumberType::float64, {}, h.operator_width, 1, 1, {every(steps_per_state)}});
  }
  for (TableLayout& layout : shape_layouts(h)) all.push_back(std::move(layout));
  return all;
}

template <class T>
void append(TableFile& file, const char* table, const std::vector<T>& numbers, std::size_t width) {
  file.append(table, numbers.data(), numbers.size() / width);
}

/// Device and number of what a path leads to; {}: to nothing.
RecordingWriter::FileId id_of(const std::string& path) {
  struct stat file {};
  if (stat(path.c_str(), &file) != 0) return {};
  return {file.st_dev, file.st_ino};
}

void rename_to(const std::string& path, const std::string& from) {
  if (std::rename(from.c_str(), path.c_str()) != 0)
    throw WriteError(fmt::format("{}: cannot take the place of what was there: {}", path, std::strerror(errno)));
}

/// Where a recording of that name lies: it is renamed into its place, so of a link the file behind it is meant, and
/// what is no file, such as a device, would be lost.
std::string place_of(const std::string& path) {
  const std::string place = behind_links(path);
  if (is_there(place) && !is_file(place))
    throw WriteError(fmt::format("{}: cannot be written: {}; name a file", path, why_no_file(place)));
  return place;
}

}  // namespace

/// Of a writer that could not begin, and has none of its own yet, whatever it left.
RecordingWriter::Beside::~Beside() {
  const FileId now = id_of(path);
  if (own[0] == FileId{} || now == own[0] || now == own[1]) std::remove(path.c_str());
}

/// Each file is complete and closed before one gets the recording's name.
void RecordingWriter::write_both(const std::function<void(const std::string& path)>& write) {
  write(next_.path);
  write(before_.path);
  rename_to(path_, before_.path);
  own_ = {id_of(path_), id_of(next_.path)};
}

RecordingWriter::RecordingWriter(std::string path, const RecordingHeader& header, const std::vector<FixedTable>& tables)
    : path_(place_of(path)), next_{path_ + ".next", own_}, before_{path_ + ".before", own_}, header_(header) {
  write_both([&](const std::string& to) {
    TableFile file = TableFile::create(to);
    file.set_text("schema", schema + std::to_string(recording_version));
    file.set_text("software", header.software);
    file.set_text("setup", header.setup);
    file.set_number("step_s", header.step_s);
    file.set_attribute("", {"tools", header.tools});
    file.set_attribute("", {"branches", header.branches});
    file.set_attribute("", {"script_steps", header.script_steps});
    file.set_attribute("", {"frame", header.frame});
    for (const TableLayout& layout : layouts(header)) file.add_table(layout);
    for (const FixedTable& table : tables) {
      file.add_table(table.layout);
      file.append(table.layout.name, table.rows, table.count);
    }
    file.close();
  });
}

namespace {

/// Rows of a table whose steps are not later than this; steps rise from row to row.
std::size_t rows_until(const TableFile& file, const char* table, std::size_t steps) {
  const std::size_t rows = file.rows(table), width = static_cast<std::size_t>(file.width(table));
  const std::vector<double> all = file.numbers(table, 0, rows);
  std::size_t count = rows;
  while (count > 0 && all[(count - 1) * width] > static_cast<double>(steps)) --count;
  return count;
}

void cut_short(TableFile& file, const RecordingHeader& header, std::size_t steps) {
  file.shorten("inputs", steps), file.shorten("hash", steps);
  file.shorten("signals", steps / steps_per_signal);
  file.shorten("events", rows_until(file, "events", steps));
  if (header.full)
    file.shorten("state", steps / steps_per_state + 1), file.shorten("hands", steps / steps_per_state + 1);
  if (header.steps_per_shape > 0 && !header.shapes.empty()) {
    const std::size_t rows = rows_until(file, "shapes_step", steps);
    file.shorten("shapes_step", rows), file.shorten("shapes_inserted", rows);
    for (const RecordedShape& shape : header.shapes) file.shorten(shape_table(shape.tool), rows);
  }
  file.remove("end");
}

}  // namespace

RecordingWriter::RecordingWriter(std::string path, const RecordingHeader& header, const std::string& from,
                                 std::size_t steps)
    : path_(place_of(path)), next_{path_ + ".next", own_}, before_{path_ + ".before", own_}, header_(header) {
  {
    const RecordingReader before(from);
    if (before.input_columns() != header.input_columns || before.signal_columns() != header.signal_columns ||
        before.tables().has("state") != header.full || (header.full && before.state_width() != header.state_width) ||
        before.steps() < steps || steps % steps_per_state != 0 ||
        (header.full && before.states() < steps / steps_per_state + 1))
      throw LoadError(fmt::format("{}: is not {} whole seconds of this run; expected its own recording", from,
                                  steps / steps_per_state));
  }
  write_both([&](const std::string& to) {
    std::error_code problem;
    std::filesystem::copy_file(from, to, std::filesystem::copy_options::overwrite_existing, problem);
    if (problem) throw write_error(to, problem.message());
    TableFile file = TableFile::open(to, true);
    cut_short(file, header_, steps);
    file.close();
  });
}

void RecordingWriter::write(TableFile& file, const RecordingBlock& block) const {
  append(file, "inputs", block.inputs, header_.input_columns.size());
  append(file, "hash", block.hashes, 1);
  append(file, "signals", block.signals, header_.signal_columns.size());
  append(file, "events", block.events, 4);
  if (!block.shape_steps.empty()) {
    append(file, "shapes_step", block.shape_steps, 1);
    append(file, "shapes_inserted", block.shape_inserted_m, header_.shapes.size());
    for (std::size_t t = 0; t < header_.shapes.size(); ++t)
      append(file, shape_table(header_.shapes[t].tool).c_str(), block.shapes_m[t],
             3 * header_.shapes[t].from_tip_m.size());
  }
  if (!header_.full) return;
  append(file, "state", block.states, static_cast<std::size_t>(header_.state_width));
  append(file, "hands", block.hands, static_cast<std::size_t>(header_.operator_width));
}

/// Swaps the two files. The recording's name moves to the newer file in one rename; the older one keeps a second name
/// until then.
void RecordingWriter::take_turns() const {
  std::remove(before_.path.c_str());
  if (link(path_.c_str(), before_.path.c_str()) != 0) throw write_error(path_, std::strerror(errno));
  rename_to(path_, next_.path);
  rename_to(next_.path, before_.path);
}

/// Who removes or renames the folder of a run takes both files along. What has their names then is another run's.
TableFile RecordingWriter::open_next() const {
  if (const FileId next = id_of(next_.path); next == FileId{} || (next != own_[0] && next != own_[1]))
    throw WriteError(
        fmt::format("{}: cannot be written on, since {} is {}; was its folder removed or renamed? What was recorded "
                    "until then went "
                    "with it",
                    path_, next_.path, next == FileId{} ? "gone" : "another's"));
  return TableFile::open(next_.path, true);
}

void RecordingWriter::commit(RecordingBlock block) {
  TableFile file = open_next();
  write(file, last_);
  write(file, block);
  file.close();
  take_turns();
  last_ = std::move(block);
}

void RecordingWriter::finish(const std::string& end) {
  TableFile file = open_next();
  write(file, last_);
  file.set_text("end", end);
  file.close();
  rename_to(path_, next_.path);
}

RecordingReader::RecordingReader(const std::string& path) : path_(path), file_(TableFile::open(path)) {
  if (!file_.has("schema"))
    throw LoadError(path + ": is an HDF5 file of another program; expected a recording of `ostium run`");
  require_version();
  if (file_.rows("inputs") != steps())
    throw LoadError(path + ": has another number of inputs than of steps; it is damaged");
  require_layout();
}

void RecordingReader::require_version() {
  const std::string found = file_.text("schema");
  if (found.rfind(schema, 0) != 0)
    throw LoadError(fmt::format("{}: is of schema \"{}\"; expected {}{}", path_, found, schema, recording_version));
  for (version_ = oldest_recording_version; version_ <= recording_version; ++version_)
    if (found == schema + std::to_string(version_)) return;
  throw LoadError(
      fmt::format("{}: is a recording of version {}, written by {}; this ostium reads versions {} to {}, whose "
                  "state and inputs are laid out otherwise",
                  path_, found.substr(schema.size()), file_.has("software") ? file_.text("software") : "?",
                  oldest_recording_version, recording_version));
}

/// What readers rely on as they index rows.
void RecordingReader::require_layout() const {
  const auto columns = [&](const char* table) { return static_cast<int>(file_.columns(table).size()); };
  if (file_.width("inputs") != columns("inputs") || file_.width("signals") != columns("signals") ||
      file_.width("hash") != 1 || file_.width("events") != 4)
    throw LoadError(path_ + ": has rows of another width than its columns' names say; it is damaged");
  if (file_.rows("signals") > steps() / steps_per_signal + 1 || states() > steps() / steps_per_state + 1)
    throw LoadError(path_ + ": has more signals or states than its steps have; it is damaged");
  // Of a run that was killed the tables end at different steps.
  if (end() && file_.rows("signals") < steps() / steps_per_signal)
    throw LoadError(fmt::format("{}: has signals of {} of its {} steps: they are cut short; copy the file again", path_,
                                file_.rows("signals") * steps_per_signal, steps()));
}

double RecordingReader::step_s() const {
  const bool as_text = version_ == 2;
  const std::optional<double> step_s = as_text ? decimal(file_.text("step_s")) : file_.number("step_s");
  if (!step_s || !(*step_s > 0 && *step_s <= 0.01))
    throw LoadError(fmt::format("{}: its step is {:.40} s; expected a number above 0, up to 0.01: it is damaged", path_,
                                as_text ? file_.text("step_s") : fmt::format("{}", *step_s)));
  return *step_s;
}

std::vector<double> RecordingReader::inputs(std::size_t first, std::size_t count) const {
  std::vector<double> rows = file_.numbers("inputs", first, count);
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!std::isfinite(rows[i])) {
      const std::vector<std::string> names = input_columns();
      throw LoadError(fmt::format("{}: {} is {} in step {}; it is damaged", path_, names[i % names.size()], rows[i],
                                  first + i / names.size() + 1));
    }
  return rows;
}

std::optional<std::string> RecordingReader::end() const {
  if (!file_.has("end")) return {};
  return file_.text("end");
}

std::string shape_table(const std::string& tool) {
  std::string name = tool;
  std::replace(name.begin(), name.end(), '/', '_');  // which makes groups
  return "shapes/" + name;
}

std::string unit_in_name(const std::string& column) {
  static constexpr std::pair<std::string_view, const char*> endings[] = {
      {"_rad_s", "rad/s"}, {"_m3_s", "m3/s"}, {"_kg_m3", "kg/m3"}, {"_1_min", "1/min"}, {"_m_s", "m/s"},
      {"_rad", "rad"},     {"_Pa", "Pa"},     {"_ug", "ug"},       {"_U", "U"},         {"_m", "m"}};
  const std::string_view name = std::string_view(column).substr(0, column.find('['));
  for (const auto& [ending, unit] : endings)
    if (name.ends_with(ending)) return unit;
  return "1";
}

void read_to_end(const std::string& path) {
  constexpr std::size_t at_once = 1 << 20;  // numbers
  const RecordingReader recording(path);
  const TableFile& file = recording.tables();
  for (const char* text : {"software", "setup"}) file.text(text);
  for (const std::string& list : file.lists_of_texts("")) file.texts("", list);
  recording.step_s();
  recording.end();
  std::vector<std::string> tables = {"inputs", "hash",          "signals",        "events",      "state",
                                     "hands",  "mesh_vertices", "mesh_triangles", "shapes_step", "shapes_inserted"};
  if (file.has("shapes"))
    for (const std::string& tool : recording.tools()) tables.push_back(shape_table(tool));
  for (const std::string& table : tables) {
    if (!file.has(table)) continue;
    for (const std::string& list : file.lists_of_texts(table)) file.texts(table, list);
    const std::size_t rows = file.rows(table), piece = 1 + at_once / static_cast<std::size_t>(file.width(table));
    const bool whole = table == "hash" || table == "mesh_triangles" || table == "shapes_step";
    for (std::size_t first = 0; first < rows; first += piece) {
      const std::size_t count = std::min(piece, rows - first);
      if (whole)
        file.integers(table, first, count);
      else
        file.numbers(table, first, count);
    }
  }
}

}  // namespace ostium::data
