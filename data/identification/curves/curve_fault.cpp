#include "data/identification/curves/curve_fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "data/identification/curves/kinds.h"

namespace ostium::data::curves {

namespace {

struct OtherUnit {
  const char *suffix, *name;
  double factor;  ///< what to multiply by if the number was in that unit
};

constexpr OtherUnit other_units[] = {{"_mm", "cm", 10},
                                     {"_mm", "m", 1000},
                                     {"_mm", "inches", 25.4},
                                     {"_mm", "um", 1e-3},
                                     {"_N", "gram-force", 9.80665e-3},
                                     {"_N", "pound-force", 4.44822},
                                     {"_N", "mN", 1e-3},
                                     {"_N", "kilogram-force", 9.80665},
                                     {"_Nmm", "N m", 1000},
                                     {"_Nmm", "mN m", 1},
                                     {"_Nmm", "gf cm", 9.80665e-2},
                                     {"_Nmm", "ozf in", 7.06155},
                                     {"_Nmm", "mN mm", 1e-3},
                                     {"_deg", "radians", 57.29578},
                                     {"_deg", "turns", 360},
                                     {"_s", "ms", 1e-3},
                                     {"_s", "minutes", 60},
                                     {"_atm", "bar", 0.986923},
                                     {"_atm", "psi", 0.0680460},
                                     {"_atm", "kPa", 9.86923e-3},
                                     {"_atm", "mmHg", 1.31579e-3},
                                     {"_mL_s", "mL/min", 1.0 / 60}};

/// The runs of a file.
JsonValue* runs_of(JsonValue& root) {
  for (auto& [key, value] : root.members)
    if (key == "runs") return &value;
  return nullptr;
}

bool numeric(const JsonValue& value) {
  if (value.type == JsonValue::Type::number) return true;
  return value.type == JsonValue::Type::array && !value.items.empty() &&
         std::all_of(value.items.begin(), value.items.end(), [](const JsonValue& v) { return numeric(v); });
}

void multiply(JsonValue& value, double factor) {
  if (value.type == JsonValue::Type::number) value.number *= factor;
  for (JsonValue& item : value.items) multiply(item, factor);
}

std::string id_of(const JsonValue& run) {
  const JsonValue* id = run.find("id");
  return id ? id->text : "";
}

/// Adds the fault if what it makes of the file can be read.
void add(Fault fault, const JsonValue& mended, std::vector<Fault>& out) {
  try {
    fault.set = read_set(mended);
  } catch (const LoadError&) {
    return;
  }
  fault.root = std::make_shared<const JsonValue>(mended);
  out.push_back(std::move(fault));
}

/// Whether a number is in the unit: "time_s" is in s, but "frames_per_s" and "rate_mL_s" are not.
bool in_unit(const std::string& key, const std::string& suffix) {
  if (!key.ends_with(suffix) || key.ends_with("_per" + suffix)) return false;
  return suffix != "_s" || !key.ends_with("_mL_s");
}

void add_units(const JsonValue& root, std::size_t r, std::vector<Fault>& out) {
  JsonValue copy = root;
  JsonValue& run = runs_of(copy)->items[r];
  for (auto& [key, value] : run.members) {
    if (!numeric(value)) continue;
    for (const OtherUnit& unit : other_units) {
      if (!in_unit(key, unit.suffix) || unit.factor == 1) continue;
      const JsonValue before = value;
      multiply(value, unit.factor);
      add({"unit_error",
           {id_of(run)},
           fmt::format("{} of {} is in {}", key, id_of(run), unit.name),
           fmt::format("multiply by {:g}", unit.factor),
           nullptr,
           nullptr,
           0,
           {}},
          copy, out);
      value = before;
    }
  }
}

/// Exchanges what was measured: all that is a list.
void add_swaps(const JsonValue& root, std::size_t r, std::vector<Fault>& out) {
  const std::size_t count = root.find("runs")->items.size();
  for (std::size_t other = 0; other < count; ++other) {
    if (other == r) continue;
    JsonValue copy = root;
    JsonValue &a = runs_of(copy)->items[r], &b = runs_of(copy)->items[other];
    for (auto& [key, value] : a.members)
      for (auto& [other_key, other_value] : b.members)
        if (key == other_key && numeric(value) && value.type == JsonValue::Type::array) std::swap(value, other_value);
    add({"swapped_experiments",
         {id_of(a), id_of(b)},
         fmt::format("what was measured in {} and {} has changed places", id_of(a), id_of(b)),
         "exchange them",
         nullptr,
         nullptr,
         0,
         {}},
        copy, out);
  }
}

/// Samples whose times run back are put in order; those whose times run on, in the reverse order.
void add_order(const JsonValue& root, std::size_t r, std::vector<Fault>& out) {
  JsonValue copy = root;
  JsonValue& run = runs_of(copy)->items[r];
  const JsonValue* time = run.find("time_s");
  if (!time || !numeric(*time) || time->type != JsonValue::Type::array) return;
  std::vector<double> t;
  for (const JsonValue& v : time->items) t.push_back(v.number);
  const bool runs_on = std::is_sorted(t.begin(), t.end());
  std::vector<std::size_t> order(t.size());
  std::iota(order.begin(), order.end(), 0);
  if (runs_on)
    std::reverse(order.begin(), order.end());
  else
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return t[a] < t[b]; });
  const auto in_order = [&](JsonValue& list) {
    std::vector<JsonValue> items;
    for (const std::size_t k : order) items.push_back(list.items[k]);
    list.items = std::move(items);
  };
  for (auto& [key, value] : run.members) {
    if (!numeric(value) || value.type != JsonValue::Type::array || (runs_on && key == "time_s")) continue;
    if (value.items.size() == t.size()) in_order(value);
    for (JsonValue& row : value.items)
      if (row.items.size() == t.size()) in_order(row);
  }
  add({"shuffled_time",
       {id_of(run)},
       fmt::format("the samples of {} are {}", id_of(run), runs_on ? "in reverse order" : "not in order of time"),
       runs_on ? "reverse them" : "sort them by time_s",
       nullptr,
       nullptr,
       0,
       {}},
      copy, out);
}

/// Multiplies a column of all runs; false if one has none of it.
bool multiply_all(JsonValue& root, const std::string& key, double factor) {
  std::size_t with = 0;
  std::vector<JsonValue>& runs = runs_of(root)->items;
  for (JsonValue& run : runs)
    for (auto& [name, value] : run.members)
      if (name == key && numeric(value)) multiply(value, factor), ++with;
  return with == runs.size();
}

/// Who has two columns in another unit has their noise in it, too.
void multiply_noise(JsonValue& root, const std::vector<std::string>& keys, double factor) {
  for (auto& [name, noise] : root.members)
    for (auto& [key, value] : noise.members)
      if (name == "noise" && numeric(value) && std::ranges::find(keys, key) != keys.end()) multiply(value, factor);
}

/// What was measured sample by sample: the columns of the first run.
std::vector<std::string> columns_of(const JsonValue& root) {
  std::vector<std::string> out;
  for (const auto& [key, value] : root.find("runs")->items.front().members)
    if (numeric(value) && value.type == JsonValue::Type::array) out.push_back(key);
  return out;
}

/// Numbers that are made smaller lie closer together: each is as much less likely as it was. Those that nothing
/// predicts, but that are given, cost nothing.
double density_cost(const Set& set, const std::string& key, double factor) {
  double count = 0;
  for (const Run& run : set.runs())
    for (const Channel& channel : run.channels)
      if (channel.key == key) count += static_cast<double>(channel.measured.size());
  return -2 * count * std::log(std::fabs(factor));
}

}  // namespace

std::vector<Fault> mends_of_all(const JsonValue& root) {
  std::vector<Fault> out;
  std::vector<std::string> ids;
  for (const JsonValue& run : root.find("runs")->items) ids.push_back(id_of(run));
  const std::vector<std::string> columns = columns_of(root);
  const auto try_one = [&](const std::string& id, const std::vector<std::string>& keys, double factor,
                           const std::string& what, const std::string& mend) {
    JsonValue copy = root;
    bool all = true;
    for (const std::string& key : keys) all = multiply_all(copy, key, factor) && all;
    if (keys.size() > 1) multiply_noise(copy, keys, std::fabs(factor));
    const std::size_t before = out.size();
    if (all) add({id, ids, what, mend, nullptr, nullptr, 0, {}}, copy, out);
    if (out.size() == before) return;
    constexpr double of_two = 6;  // strong evidence: often one column alone explains it as well
    out[before].paid = keys.size() > 1 ? of_two : density_cost(*out[before].set, keys[0], factor);
  };
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string& key = columns[i];
    for (const OtherUnit& unit : other_units) {
      if (!in_unit(key, unit.suffix) || unit.factor == 1) continue;
      const std::string mend = fmt::format("multiply by {:g}", unit.factor);
      try_one("unit_error", {key}, unit.factor, fmt::format("{} of all runs is in {}", key, unit.name), mend);
      for (std::size_t j = i + 1; j < columns.size(); ++j)
        if (in_unit(columns[j], unit.suffix))
          try_one("unit_error", {key, columns[j]}, unit.factor,
                  fmt::format("{} and {} of all runs are in {}", key, columns[j], unit.name), mend);
    }
    try_one("sign_error", {key}, -1, fmt::format("{} of all runs has the other sign", key), "multiply by -1");
    for (std::size_t j = i + 1; j < columns.size(); ++j)
      try_one("sign_error", {key, columns[j]}, -1,
              fmt::format("{} and {} of all runs have the other sign", key, columns[j]), "multiply by -1");
  }
  return out;
}

std::vector<Fault> left_out(const std::shared_ptr<const Set>& set) {
  std::vector<Fault> out;
  for (std::size_t r = 0; r < set->runs().size(); ++r) {
    Fault fault{"outlier_experiment",
                {set->runs()[r].id},
                set->runs()[r].id + " does not agree with the others",
                "look at it, or make it again; it is left out",
                set,
                nullptr,
                0,
                {}};
    for (std::size_t k = 0; k < set->runs().size(); ++k)
      fault.chosen.emplace_back(set->runs()[k].channels.size(), k != r);
    out.push_back(std::move(fault));
  }
  return out;
}

std::vector<Fault> mends_of(const JsonValue& root, std::size_t r) {
  std::vector<Fault> out;
  add_units(root, r, out);
  add_swaps(root, r, out);
  add_order(root, r, out);
  return out;
}

}  // namespace ostium::data::curves
