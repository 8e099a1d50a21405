#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>

#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/progress.h"
#include "app/commands/explain_curves.h"
#include "data/catalogue/catalogue.h"
#include "data/catalogue/instrument/instrument_reader.h"
#include "data/formats/csv_table.h"
#include "data/formats/write_file.h"
#include "data/identification/characterisation/characterisation_report.h"
#include "data/identification/curves/kinds.h"
#include "data/identification/forward/prediction.h"
#include "data/identification/measurement/measurement_reader.h"

namespace ostium::app {

namespace {

struct Arguments {
  std::string set;           ///< the set's folder or its measurement.json
  std::string folder = ".";  ///< where prediction.json and prediction.csv go
  std::string with;          ///< an instrument whose stiffness takes the place of the declared one; empty: none
  bool json = false;         ///< prediction.json to stdout instead of a table
};

void declare(Options& options, Arguments& a) {
  add_measured_set_option(options, a.set);
  options.add("-o,--out", a.folder, "Where prediction.json and prediction.csv go").type("DIR");
  options
      .add("--with", a.with,
           "An instrument of the catalogue, or its file, in place of what the set declares of stiffness (and of "
           "friction, "
           "if the file has it); says in check.json whether it agrees with the set, errors and noise considered")
      .type("NAME|FILE");
  options.flag("--json", a.json, "Print prediction.json, see data/schemas/prediction.schema.json");
}

void print_table(const std::vector<data::Prediction>& predictions) {
  const data::MisfitUnit unit = predictions.front().unit;
  fmt::print("{:<24} {:>10} {:>10} {:>10} {:>12}\n", "experiment", "tip x mm", "y", "z", "off by " + unit.name);
  double sum = 0;
  std::size_t compared = 0;
  for (const data::Prediction& p : predictions) {
    const Eigen::Vector3d tip = 1e3 * p.shape.points_m.back();
    fmt::print("{:<24} {:>10.3f} {:>10.3f} {:>10.3f} {:>12}\n", p.id, tip.x(), tip.y(), tip.z(),
               p.rms_to_measured_m ? fmt::format("{:.3f}", *p.rms_to_measured_m / unit.size) : "-");
    if (!p.rms_to_measured_m) continue;
    sum += *p.rms_to_measured_m * *p.rms_to_measured_m;
    ++compared;
  }
  if (compared > 0)
    fmt::print("root mean square over {} experiments: {:.3f} {}\n", compared,
               std::sqrt(sum / static_cast<double>(compared)) / unit.size, unit.name);
  else
    fmt::print("the measuring frame or the tracked point is free: ostium explain fits them\n");
}

void predict_shapes(const Arguments& a, const data::MeasurementSet& set) {
  if (const std::string doubt = set.table.empty() ? "" : data::doubt_of_end(set.table); !doubt.empty())
    fmt::print(stderr, "ostium predict: {}\n", doubt);
  const auto predictions = predict(set, [&](std::size_t done, std::size_t of) {
    show_progress(done < of ? fmt::format("experiment {} of {}", done, of) : "");
  });
  for (const data::Prediction& p : predictions)
    for (const double apart_m : p.other_branches_m)
      fmt::print(stderr, "ostium predict: {} has another stable shape, its tip {:.1f} mm away\n", p.id, 1e3 * apart_m);
  const std::filesystem::path folder(a.folder);
  data::write_files({{(folder / "prediction.json").string(), to_json(predictions)},
                     {(folder / "prediction.csv").string(), to_csv(predictions)}});
  if (a.json)
    fmt::print("{}", to_json(predictions));
  else
    print_table(predictions);
}

int run(const Arguments& a) {
  require_none_of_set(a.set, "--out", a.folder, {"prediction.json", "prediction.csv", "check.json"});
  const data::JsonValue as_read = data::load_json(data::measurement_file(a.set));
  data::CharacterisedWire wire;
  if (!a.with.empty()) wire = data::wire_in(data::load_instrument(data::instrument_file(a.with)));
  const data::JsonValue root = a.with.empty() ? as_read : set_with(as_read, in_set(wire));
  std::optional<data::WireCheck> found;  // before anything is written, as it may be refused
  if (!a.with.empty()) found = check(as_read, wire, [](const std::string& words) { show_progress(words); });
  show_progress("");
  if (data::curves::kind_of(root))
    predict_curves(root, a.folder, a.json);
  else  // as it lies there, where nothing is changed: messages have its lines
    predict_shapes(a,
                   a.with.empty() ? data::load_measurement(a.set) : data::read_measurement(*root.file, to_json(root)));
  if (!found) return 0;
  data::write_file((std::filesystem::path(a.folder) / "check.json").string(), to_json(*found));
  fmt::print(a.json ? stderr : stdout, "with {}: off by {}\n", a.with, words_of(*found));
  return 0;
}

}  // namespace

Command predict_command() {
  return make_command("predict", "The static shapes that a measured set declares, nothing fitted",
                      {"ostium predict my-wire", "ostium predict my-wire/measurement.json -o shapes",
                       "ostium predict push --with my-wire.json"},
                      declare, run);
}

}  // namespace ostium::app
