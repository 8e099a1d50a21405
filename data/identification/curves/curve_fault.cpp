#include "data/identification/curves/curve_fault.h"

#include <fmt/format.h>

#include <algorithm>
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
       {}},
      copy, out);
}

}  // namespace

std::vector<Fault> left_out(const std::shared_ptr<const Set>& set) {
  std::vector<Fault> out;
  for (std::size_t r = 0; r < set->runs().size(); ++r) {
    Fault fault{"outlier_experiment",
                {set->runs()[r].id},
                set->runs()[r].id + " does not agree with the others",
                "look at it, or make it again; it is left out",
                set,
                nullptr,
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
