#include "data/identification/measurement/projection_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "data/formats/csv_table.h"
#include "data/identification/measurement/experiment_reader.h"
#include "data/identification/measurement/measurement_parts.h"
#include "data/identification/measurement/number_lists.h"
#include "data/identification/measurement/polyline_checks.h"
#include "data/identification/measurement/projection_keys.h"
#include "data/identification/measurement/view_reader.h"

namespace ostium::data {

namespace {

std::optional<int> view_index(const MeasurementSet& set, const std::string& id) {
  for (std::size_t v = 0; v < set.views.size(); ++v)
    if (set.views[v].id == id) return static_cast<int>(v);
  return {};
}

std::string view_ids(const MeasurementSet& set) {
  std::string out;
  for (const MeasuredCArm& view : set.views) out += (out.empty() ? "" : ", ") + view.id;
  return out;
}

const ClickedPolyline* polyline_in(const Experiment& e, int view) {
  for (const ClickedPolyline& polyline : e.polylines)
    if (polyline.view == view) return &polyline;
  return nullptr;
}

ClickedPolyline read_polyline(const JsonValue& value, const MeasurementSet& set, const Experiment& e) {
  const JsonObject entry(value, projection_keys::projection);
  ClickedPolyline out;
  const std::optional<int> view = view_index(set, entry.text("view"));
  if (!view) entry["view"].refuse("the id of a view: " + view_ids(set));
  if (polyline_in(e, *view)) entry["view"].refuse("a view that this experiment does not have yet");
  out.view = *view;
  const auto& points = entry.list("polyline_px");
  if (points.size() < 2) entry.refuse("polyline_px");
  for (const JsonValue& point : points) out.points_px.push_back(vector2(point));
  std::optional<std::size_t> wrong;
  const std::string doubt = doubt_of(set.views[*view], e, out, wrong);
  if (wrong) points[*wrong].refuse(doubt.substr(doubt.find(' ') + 1));
  if (!doubt.empty()) entry["polyline_px"].fail(entry["polyline_px"].path() + ": " + doubt);
  return out;
}

Experiment read_projected(const JsonValue& value, const MeasurementSet& set) {
  const JsonObject entry(value, projection_keys::experiment);
  Experiment e = read_setting(entry, set);
  e.kind = Experiment::Kind::projections;
  if (entry.has("projections"))
    for (const JsonValue& item : entry.list("projections")) e.polylines.push_back(read_polyline(item, set, e));
  return e;
}

/// Rows of one experiment and view in the file's order are its polyline.
void read_table(const std::string& file, MeasurementSet& set) {
  const std::vector<std::string> columns = {"experiment", "view", "column_px", "row_px"};
  const auto fail = [&](const CsvRow& row, const std::string& what) {
    throw LoadError(fmt::format("{}:{}: {}", file, row.line, what));
  };
  for (const CsvRow& row : load_csv(file, columns)) {
    const auto e = std::find_if(set.experiments.begin(), set.experiments.end(),
                                [&](const Experiment& x) { return x.id == row.fields[0]; });
    if (e == set.experiments.end())
      fail(row, "experiment is \"" + row.fields[0] + "\"; expected the id of an experiment of the set");
    const std::optional<int> view = view_index(set, row.fields[1]);
    if (!view) fail(row, "view is \"" + row.fields[1] + "\"; expected the id of a view: " + view_ids(set));
    if (!polyline_in(*e, *view)) e->polylines.push_back({*view, {}});
    if (e->polylines.back().view != *view)
      fail(row, fmt::format("view \"{}\" of experiment \"{}\" goes on after another; expected its rows together",
                            row.fields[1], e->id));
    e->polylines.back().points_px.emplace_back(csv_number(file, row, columns[2], row.fields[2]),
                                               csv_number(file, row, columns[3], row.fields[3]));
  }
  for (const Experiment& e : set.experiments)
    for (const ClickedPolyline& polyline : e.polylines) {
      const std::string which =
          fmt::format("{}: experiment \"{}\", view \"{}\"", file, e.id, set.views[polyline.view].id);
      if (polyline.points_px.size() < 2) throw LoadError(which + " has one point; expected at least two");
      std::optional<std::size_t> wrong;
      const std::string doubt = doubt_of(set.views[polyline.view], e, polyline, wrong);
      if (wrong) throw LoadError(fmt::format("{}, point {}: {}", which, *wrong + 1, doubt));
      if (!doubt.empty()) throw LoadError(which + ": " + doubt);
    }
}

void read_clicking(const JsonValue& value, MeasurementSet& set) {
  const JsonObject entry(value, projection_keys::imaging);
  if (const auto noise_px = entry.number_or_null("noise_sigma_px"))
    set.imaging.noise_sigma_m = *noise_px * set.unit().size;
  entry.choice("views", {"given"});
}

}  // namespace

MeasurementSet read_projections(const JsonValue& file) {
  const JsonObject root(file, projection_keys::set);
  MeasurementSet set;
  set.file = *file.file;
  set.title = root.text("title");
  if (root.has("source")) set.source = root.text("source");
  read_instruments(root, set);
  read_environment(root["environment"], set);
  for (const JsonValue& value : root.list("views")) set.views.push_back(read_view(value, set));
  if (set.views.empty()) root.refuse("views");
  read_clicking(root["imaging"], set);
  read_effects(root, set);
  for (const JsonValue& value : root.list("experiments")) set.experiments.push_back(read_projected(value, set));
  if (set.experiments.empty()) root.refuse("experiments");
  const bool table = root.has("polylines_csv");
  for (const Experiment& e : set.experiments)
    if (table && !e.polylines.empty())
      root["polylines_csv"].fail(e.place + ".projections and polylines_csv; expected one of them");
  if (table) set.table = (std::filesystem::path(set.file).parent_path() / root.text("polylines_csv")).string();
  if (table) read_table(set.table, set);
  for (const Experiment& e : set.experiments)
    if (e.polylines.empty())
      root["experiments"].fail(e.place + " has no polyline; expected one of at least one view" +
                               (table ? " in " + root.text("polylines_csv") : ", its projections"));
  require_noise_above_rounding(*root["imaging"].find("noise_sigma_px"), set);
  return set;
}

}  // namespace ostium::data
