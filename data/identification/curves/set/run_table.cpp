#include "data/identification/curves/set/run_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "data/formats/csv_table.h"
#include "data/formats/load_error.h"

namespace ostium::data::curves {

namespace {

/// A run while its table is written out.
class WrittenOut {
 public:
  WrittenOut(JsonValue& run, const JsonValue& name) : run_(run) {
    if (name.type != JsonValue::Type::text || name.text.empty()) name.refuse("the name of a table");
    const std::string path = (std::filesystem::path(*name.file).parent_path() / name.text).string();
    file_ = std::make_shared<const std::string>(path);
    table_ = load_csv(path, "of a run, named as its keys");
    for (std::size_t c = 0; c < table_.columns.size(); ++c) add(c);
  }

 private:
  /// Where "[1]" begins, if that is how it ends: "Time [s]" has no index.
  static std::size_t index_in(const std::string& name) {
    const std::size_t bracket = name.find('[');
    if (bracket == std::string::npos || bracket == 0 || name.back() != ']') return std::string::npos;
    const auto digits = name.find_first_not_of("0123456789", bracket + 1);
    return digits == name.size() - 1 && digits > bracket + 1 ? bracket : std::string::npos;
  }

  /// "density_mm[1]": key and index.
  void add(std::size_t column) {
    const std::string& name = table_.columns[column];
    const std::size_t bracket = index_in(name);
    const std::string key = name.substr(0, bracket);
    JsonValue& list = list_of(key, column);
    if (bracket == std::string::npos) {
      if (!list.items.empty()) refuse(name, "a column of that name comes before it");
      list.items = numbers(column, list.place);
      return;
    }
    if (name != fmt::format("{}[{}]", key, list.items.size()))
      refuse(name, fmt::format("expected {}[{}]", key, list.items.size()));
    JsonValue inner = like(list);
    inner.place = std::make_shared<const JsonPlace>(JsonPlace{list.place, "", list.items.size()});
    inner.items = numbers(column, inner.place);
    list.items.push_back(inner);
  }

  [[noreturn]] void refuse(const std::string& column, const std::string& why) const {
    throw LoadError(fmt::format("{}:{}: column \"{}\": {}", *file_, table_.header_line, column, why));
  }

  JsonValue like(const JsonValue& other) const {
    JsonValue out;
    out.type = other.type, out.line = other.line, out.file = other.file;
    return out;
  }

  /// The run's list of that key; a new one unless a column before it began it.
  JsonValue& list_of(const std::string& key, std::size_t column) {
    if (key.empty()) refuse(table_.columns[column], "expected a key of the run");
    const auto known =
        std::find_if(run_.members.begin(), run_.members.end(), [&](const auto& m) { return m.key == key; });
    if (known != run_.members.end()) {
      if (known->value.file != file_) refuse(table_.columns[column], "the run has that key itself, too");
      return known->value;
    }
    JsonValue list;
    list.type = JsonValue::Type::array, list.line = table_.header_line, list.file = file_;
    list.place = std::make_shared<const JsonPlace>(JsonPlace{run_.place, key, {}});
    run_.members.push_back({key, list});
    return run_.members.back().value;
  }

  std::vector<JsonValue> numbers(std::size_t column, const std::shared_ptr<const JsonPlace>& list) const {
    std::vector<JsonValue> out;
    for (const CsvRow& row : table_.rows) {
      JsonValue value;
      value.type = JsonValue::Type::number, value.line = row.line, value.file = file_;
      value.number = csv_number(*file_, row, table_.columns[column], row.fields[column]);
      value.place = std::make_shared<const JsonPlace>(JsonPlace{list, "", out.size()});
      out.push_back(value);
    }
    return out;
  }

  JsonValue& run_;
  std::shared_ptr<const std::string> file_;
  CsvTable table_;
};

}  // namespace

JsonValue with_tables(JsonValue root) {
  for (auto& [key, runs] : root.members) {
    if (key != "runs") continue;
    for (JsonValue& run : runs.items) {
      const auto table =
          std::find_if(run.members.begin(), run.members.end(), [](const auto& m) { return m.key == "csv"; });
      if (table == run.members.end()) continue;
      const JsonValue name = table->value;
      run.members.erase(table);
      WrittenOut(run, name);
    }
  }
  return root;
}

std::vector<std::string> doubts_of_tables(const JsonValue& root) {
  std::vector<std::string> out;
  const JsonValue* runs = root.find("runs");
  for (std::size_t r = 0; runs && r < runs->items.size(); ++r) {
    const auto& members = runs->items[r].members;
    const auto table = std::find_if(members.begin(), members.end(),
                                    [&](const auto& m) { return m.value.file && *m.value.file != *root.file; });
    if (table == members.end()) continue;
    if (std::string doubt = doubt_of_end(*table->value.file); !doubt.empty()) out.push_back(std::move(doubt));
  }
  return out;
}

}  // namespace ostium::data::curves
