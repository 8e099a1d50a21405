#include "data/assessment/score_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "data/assessment/scoring_keys.h"
#include "data/catalogue/catalogue.h"
#include "data/formats/json/json_object.h"
#include "data/formats/load_error.h"
#include "data/formats/paths.h"
#include "data/formats/read_file.h"

namespace ostium::data {

namespace {

namespace fs = std::filesystem;

EventCode event_called(const JsonObject& object, const char* key) {
  const std::string name = object.text(key);
  std::string known;
  for (const EventDefinition& e : event_definitions()) {
    if (e.name == name) return e.code;
    known += (known.empty() ? "" : ", ") + e.name;
  }
  object[key].refuse("one of: " + known);
}

ScoreCheck read_check(const JsonValue& value) {
  const JsonObject object(value, scoring_keys::check);
  ScoreCheck check;
  if (object.has("event") == object.has("metric"))
    value.fail(value.path() + " must look at an event or at a metric; expected one of the two");
  if (object.has("event")) check.event = event_called(object, "event");
  if (object.has("before")) event_called(object, "before"), check.before = object.text("before");
  if (object.has("metric")) {
    check.metric = object.text("metric");
    const auto& all = metric_definitions();
    if (std::none_of(all.begin(), all.end(), [&](const MetricDefinition& m) { return m.name == check.metric; }))
      object.refuse("metric");
  }
  if (object.has("least")) check.least = object.number("least");
  if (object.has("most")) check.most = object.number("most");
  if (!check.before.empty() && (!check.metric.empty() || check.least || check.most))
    object["before"].fail(object["before"].path() +
                          " stands beside what it does not go with; expected an event, alone");
  if (check.least && check.most && *check.least > *check.most) object["most"].refuse("a number not below least");
  if (check.before.empty() && !check.least && !check.most)
    value.fail(value.path() + " has no bound; expected least, most or before");
  return check;
}

std::vector<double> times(const RunRecord& record, EventCode code) {
  std::vector<double> out;
  for (const RecordedEvent& e : events_of(record, code)) out.push_back(e.time_s);
  return out;
}

bool within(double value, const ScoreCheck& check) {
  return value >= check.least.value_or(-INFINITY) && value <= check.most.value_or(INFINITY);
}

/// As people say it: a way through the vessels is in cm, as lists and the page say it.
std::string score_text(const Metric& metric) {
  if (metric.unit == "s") return value_text(metric);
  if (metric.unit == "mm" && std::fabs(metric.value) >= 100) return fmt::format("{:.3g} cm", metric.value / 10);
  return metric.unit == "1" ? fmt::format("{:.3g}", metric.value) : fmt::format("{:.3g} {}", metric.value, metric.unit);
}

Score judge(const ScoreItem& item, const RunRecord& record, const std::vector<Metric>& metrics) {
  Score out;
  if (!item.check) return out;
  const ScoreCheck& check = *item.check;
  const auto ticked = [](bool holds) { return holds ? Ticked::yes : Ticked::no; };
  if (!check.metric.empty()) {
    const auto metric =
        std::find_if(metrics.begin(), metrics.end(), [&](const Metric& m) { return m.name == check.metric; });
    if (metric == metrics.end() || !std::isfinite(metric->value)) return out;
    out.holds = ticked(within(metric->value, check));
    out.value = score_text(*metric);
    return out;
  }
  const std::vector<double> at = times(record, *check.event);
  if (!check.before.empty()) {
    std::vector<double> limit;
    for (const EventDefinition& e : event_definitions())
      if (e.name == check.before) limit = times(record, e.code);
    if (limit.empty()) return out;                                   // that event never occurred
    out.holds = ticked(!at.empty() && at.front() <= limit.front());  // a script may give both in one step
  } else {
    out.holds = ticked(within(static_cast<double>(at.size()), check));
  }
  const auto needed = static_cast<std::size_t>(std::max(1.0, check.least.value_or(1)));
  if (item.kind != ScoreKind::step)
    out.at_s = at;
  else if (at.size() >= needed)
    out.at_s = {at[needed - 1]};
  return out;
}

}  // namespace

ScoreList read_score_list(const std::string& file, const std::string& text) {
  const JsonValue value = parse_json(file, text);
  const JsonObject object(value, scoring_keys::root);
  if (object.text("schema") != "ostium-scoring/1") object.refuse("schema");
  ScoreList list;
  list.name = object.text("name"), list.title = object.text("title"), list.note = object.text("note");
  if (list.name != fs::path(file).stem().string()) object.refuse("name");
  if (object.list("items").empty()) object.refuse("items");
  for (const JsonValue& entry : object.list("items")) {
    const JsonObject of(entry, scoring_keys::item);
    ScoreItem item;
    item.id = of.text("id");
    if (std::any_of(list.items.begin(), list.items.end(), [&](const ScoreItem& i) { return i.id == item.id; }))
      of["id"].refuse("an id that no other item has");
    item.phase = of.text("phase"), item.what = of.text("what"), item.when = of.text("when");
    item.kind = static_cast<ScoreKind>(of.choice("kind", {"step", "error", "critical"}));
    if (of.has("check")) item.check = read_check(of["check"]);
    list.items.push_back(std::move(item));
  }
  return list;
}

ScoreList find_score_list(const std::string& name_or_file) {
  const fs::path known = fs::path(data_folder()) / "scoring" / (name_or_file + ".json");
  const std::string file = is_file(known) ? known.string() : name_or_file;
  return read_score_list(file, read_file(file, "a scoring list, or a name in data/scoring", json_limits::bytes));
}

std::vector<Score> score(const ScoreList& list, const RunRecord& record, const std::vector<Metric>& metrics) {
  std::vector<Score> out;
  for (const ScoreItem& item : list.items) out.push_back(judge(item, record, metrics));
  return out;
}

}  // namespace ostium::data
