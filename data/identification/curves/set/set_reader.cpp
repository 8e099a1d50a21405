#include "data/identification/curves/set/set_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ostium::data::curves {

const JsonObjectKeys effect_keys = {
    "effect",
    {{"id", true, "the id of an effect, a text", json_type::text()},
     {"form", false, "the form of an effect that has several, a text", json_type::text()},
     {"parameters", true, "numbers by their names, an object", json_type::values_by_name({json_type::number()})}}};

std::vector<JsonKey> with_common_keys(const std::string& kind, std::vector<JsonKey> own) {
  std::vector<JsonKey> keys = {
      {"schema", true, "\"ostium-measurement/2\"", json_type::constant("ostium-measurement/2")},
      {"kind", true, "\"" + kind + "\"", json_type::constant(kind)},
      {"title", true, "what was measured, a text", json_type::text()},
      {"source", false, "who measured, how, under which licence, a text", json_type::text()},
      {"effects", false, "effects that the model is to include, a list",
       json_type::list_of(json_type::object("effect"))},
      {"fitted", false, "numbers that a fit found, by their names, an object",
       json_type::values_by_name({json_type::number()})}};
  keys.insert(keys.end(), own.begin(), own.end());
  return keys;
}

JsonObjectKeys run_keys(const std::string& object, std::vector<JsonKey> own, std::vector<JsonKey> samples) {
  JsonObjectKeys out{object,
                     {{"id", true, "a name that no other run has, a text", json_type::text()},
                      {"group", false, "what runs share, a text", json_type::text()},
                      {"csv", false, "a table beside this file with samples as columns, in place of the lists, a text",
                       json_type::text()}}};
  std::vector<std::string> lists;
  out.keys.insert(out.keys.end(), own.begin(), own.end());
  for (JsonKey& key : samples) {
    if (key.required) lists.push_back(key.name);
    key.required = false;
    out.keys.push_back(key);
  }
  out.rules = {one_of_required({{"csv"}, lists})};
  return out;
}

const JsonValue& samples(const JsonObject& run, const std::string& key) {
  if (!run.has(key))
    run.value().fail(fmt::format("{}.{} is missing; expected a list, or a column of that name in the table of \"csv\"",
                                 run.value().path(), key));
  run.list(key);
  return run[key];
}

double sample(const JsonValue& value) {
  if (value.type != JsonValue::Type::number) value.refuse("a number");
  if (!(std::fabs(value.number) <= 1e12)) value.refuse("a number up to 1e12");
  return value.number;
}

Eigen::VectorXd read_samples(const JsonObject& run, const std::string& key, Eigen::Index least) {
  const std::vector<JsonValue>& list = samples(run, key).items;
  Eigen::VectorXd out(static_cast<Eigen::Index>(list.size()));
  for (std::size_t k = 0; k < list.size(); ++k) out[static_cast<Eigen::Index>(k)] = sample(list[k]);
  if (out.size() < least)
    run[key].fail(fmt::format("{} has {} numbers; expected at least {}", run[key].path(), out.size(), least));
  return out;
}

Eigen::VectorXd read_samples_like(const JsonObject& run, const std::string& key, const Eigen::VectorXd& of,
                                  const std::string& of_key) {
  const Eigen::VectorXd out = read_samples(run, key, 0);
  if (out.size() != of.size())
    run[key].fail(
        fmt::format("{} has {} numbers; expected {}, as {} has", run[key].path(), out.size(), of.size(), of_key));
  return out;
}

void must_rise(const JsonObject& entry, const std::string& key, const Eigen::VectorXd& x) {
  for (Eigen::Index k = 1; k < x.size(); ++k)
    if (!(x[k] > x[k - 1]))
      entry.list(key)[static_cast<std::size_t>(k)].refuse(fmt::format("more than the {:g} before it", x[k - 1]));
}

Run begin_run(const JsonObject& entry, const std::vector<Run>& others) {
  Run run;
  run.id = entry.text("id"), run.place = entry.value().path();
  if (entry.has("csv")) entry["csv"].fail(run.place + ".csv: the table was not read (with_tables)");
  if (entry.has("group")) run.group = entry.text("group");
  for (const Run& other : others)
    if (other.id == run.id) entry["id"].refuse("an id that no other run has; " + other.place + " has it");
  return run;
}

namespace {

std::vector<Switched> read_effects(const JsonObject& root, const Set& set) {
  std::vector<Switched> out;
  if (!root.has("effects")) return out;
  for (const JsonValue& value : root.list("effects")) {
    const JsonObject entry(value, effect_keys);
    const std::string id = entry.text("id"), form = entry.has("form") ? entry.text("form") : "";
    const auto known = std::find_if(set.effects().begin(), set.effects().end(), [&](const EffectHead& e) {
      return e.id == id && (form.empty() || e.form == form);
    });
    if (known == set.effects().end()) {
      std::string names;
      for (const EffectHead& e : set.effects()) names += (names.empty() ? "" : ", ") + e.name();
      entry["id"].refuse("an effect that can show in this set: " + names);
    }
    Switched on{static_cast<std::size_t>(known - set.effects().begin()), {}};
    for (const EffectParameter& p : known->parameters) {
      const JsonValue* number = entry["parameters"].find(p.name);
      if (number && number->type != JsonValue::Type::number) number->refuse("a number");
      on.values.push_back(number ? number->number : p.prior);
      if (on.values.back() < p.least || on.values.back() > p.most)
        number->refuse(fmt::format("{} from {:g} to {:g} {}", p.what, p.least, p.most, p.unit));
    }
    for (const auto& [name, number] : entry["parameters"].members)
      if (std::none_of(known->parameters.begin(), known->parameters.end(),
                       [&, &key = name](const EffectParameter& p) { return p.name == key; }))
        number.fail(fmt::format("{} has no number \"{}\"", id, name));
    out.push_back(on);
  }
  return out;
}

void read_fitted(const JsonValue& fitted, std::vector<EffectParameter>& free) {
  for (const auto& [name, number] : fitted.members) {
    const auto known =
        std::find_if(free.begin(), free.end(), [&, &key = name](const EffectParameter& p) { return p.name == key; });
    if (known == free.end()) number.fail(fmt::format("no fit of this set has a number \"{}\"", name));
    if (number.type != JsonValue::Type::number || number.number < known->least || number.number > known->most)
      number.refuse(fmt::format("a number from {:g} to {:g}", known->least, known->most));
    known->prior = number.number;
  }
}

void require_noise_above_rounding(const JsonValue& root, const std::vector<Run>& runs) {
  for (std::size_t c = 0; c < runs[0].channels.size(); ++c) {
    std::vector<MeasuredNumbers> list;
    double sigma = 0;
    for (const Run& run : runs) {
      const Channel& channel = run.channels[c];
      list.push_back({run.id, {channel.measured.begin(), channel.measured.end()}});
      sigma = std::max(sigma, channel.sigma.maxCoeff());
    }
    const Channel& first = runs[0].channels[c];
    if (const std::string doubt = doubt_of_noise_below_rounding(list, sigma, first.unit); !doubt.empty())
      root.fail(fmt::format("the noise of the {} {}; expected the scatter of repeats, or null", first.label, doubt));
  }
}

}  // namespace

void declare(const JsonObject& root, Set& set) {
  if (root.text("schema") != "ostium-measurement/2") root.refuse("schema");
  set.file = *root.value().file, set.kind = root.text("kind"), set.title = root.text("title");
  if (root.has("source")) set.source = root.text("source");
  if (root.has("fitted")) read_fitted(root["fitted"], set.free_);
  set.declared_ = read_effects(root, set);
  if (set.noise_.declared) require_noise_above_rounding(root.value(), set.runs());
}

std::vector<MeasuredNumbers> measured_numbers(const std::vector<Run>& runs) {
  std::vector<MeasuredNumbers> out;
  for (const Run& run : runs) {
    out.push_back({run.id, {run.along.begin(), run.along.end()}});
    for (const Channel& channel : run.channels)
      out.back().numbers.insert(out.back().numbers.end(), channel.measured.begin(), channel.measured.end());
  }
  return out;
}

}  // namespace ostium::data::curves
