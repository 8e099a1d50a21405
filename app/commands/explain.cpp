#include "data/identification/selection/explain.h"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>

#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/filled_folder.h"
#include "app/command_line/interrupt.h"
#include "app/command_line/progress.h"
#include "app/command_line/templates.h"
#include "app/commands/explain_curves.h"
#include "data/formats/read_file.h"
#include "data/formats/write_file.h"
#include "data/identification/curves/kinds.h"
#include "data/identification/measurement/measurement_reader.h"
#include "data/identification/report/explanation_report.h"

namespace ostium::app {

namespace {

struct Arguments {
  std::string set;                 ///< the set's folder or its measurement.json
  std::string kind;                ///< of a template to write into `folder`, in place of explaining a set
  std::string folder = ".";        ///< where explanation.json, explanation.html and amended/ go
  std::vector<std::string> tries;  ///< "shaft_torsion", or several together: "shaft_torsion+stress_relaxation"
  std::string instrument;          ///< where to write the fitted innermost instrument; empty: only in `folder`
  int threads = 0;                 ///< 0: one per core
  bool json = false;               ///< explanation.json to stdout instead of text
};

void declare(Options& options, Arguments& a) {
  options.add("set", a.set, "The set's folder, or its measurement.json").type("SET");
  options
      .add("--template", a.kind,
           "Write a small set of this kind to begin from, and explain none: projections, push_pull, ...")
      .type("KIND");
  options.add("-o,--out", a.folder, "Where explanation.json, explanation.html and amended/ go").type("DIR");
  options.add("--try", a.tries, "An effect to switch on; with + between them, several together").type("EFFECT");
  options
      .add("--write-instrument", a.instrument,
           "Also here, of a set of shapes: the (innermost) instrument as it was found, for ostium run and the "
           "catalogue")
      .type("FILE.json")
      .writes();
  options.add("--threads", a.threads, "Threads of each rank; 0: one for each core").range(0, 1024);
  options.flag("--json", a.json, "Print explanation.json, see data/schemas/explanation.schema.json");
}

void print(const data::Explanation& x) {
  fmt::print("verdict: {}\n", to_string(x.verdict));
  for (const std::string& sentence : x.verdict_text) fmt::print("  {}\n", sentence);
  fmt::print("\n{:<40} {:>12} {:>12} {:>10}  {}\n", "parameter", "value", "sigma", "from data", "unit");
  for (const data::FittedParameter& p : x.best().parameters)
    fmt::print("{:<40} {:>12.5g} {:>12.2g} {:>8.0f} %  {}\n", p.parameter.name, p.value, p.sigma, 100 * p.informed,
               p.parameter.unit == "1" ? "" : p.parameter.unit);
  fmt::print("{}\n", data::sigma_is);
}

void write_found(const Arguments& a, const data::MeasurementSet& set, const data::Explanation& found) {
  const std::filesystem::path folder(a.folder);
  std::vector<data::FileText> files = {
      {(folder / "explanation.json").string(), to_json(found)},
      {(folder / "explanation.html").string(), to_html(set, found)},
      {(folder / "amended" / "measurement.json").string(), amended(data::read_file(set.file), set, found)}};
  for (std::size_t i = 0; i < set.instruments.size(); ++i) {
    const bool one = set.instruments.size() == 1, innermost = i + 1 == set.instruments.size();
    // Instruments are found by their file's name.
    const std::string name = one ? "instrument" : fmt::format("instrument-{}", i);
    files.push_back({(folder / (name + ".json")).string(), instrument_json(set, found, i, name)});
    if (innermost && !a.instrument.empty())
      files.push_back(
          {a.instrument, instrument_json(set, found, i, std::filesystem::path(a.instrument).stem().string())});
  }
  data::write_files(files);
}

int write_a_template(const Arguments& a) {
  for (const std::string& file : write_template(a.kind, a.folder)) fmt::print("{}\n", file);
  return 0;
}

/// Whether to end, asked often: a log gets its line a minute, however long a fit takes.
std::function<bool()> going_on(const TimedProgress& progress) {
  return [progress] {
    progress.go_on();
    return interrupted.load();
  };
}

/// A set of curves is quick: the first rank does it all.
int run_curves(const Arguments& a, const data::JsonValue& root) {
  if (data::rank() != 0) return 0;
  if (!a.instrument.empty())
    throw data::LoadError(*root.file +
                          ": --write-instrument is for shapes; of a bench's curves `ostium characterise` "
                          "makes an instrument");
  const FilledFolder folder(a.folder);
  data::curves::CurveOptions options;
  for (const std::string& words : a.tries) options.tries.push_back(split(words, '+'));
  const TimedProgress progress(*root.file + ": ", 60, 60);
  options.progress = progress;
  stop_on_signals();
  options.stop = going_on(progress);
  explain_curves(root, options, a.folder, a.json);
  return 0;
}

/// Under mpirun only the first rank writes.
int run(const Arguments& a) {
  if (!a.kind.empty() && a.set.empty()) return write_a_template(a);
  if (a.set.empty() || !a.kind.empty()) {
    fmt::print(stderr, "{}\n",
               a.set.empty() ? "SET is required, or --template KIND"
                             : "--template KIND writes a set to begin from, and SET names one to explain; expected one "
                               "of them");
    return 2;
  }
  require_not_of_set(a.set, "--write-instrument", a.instrument);
  require_none_of_set(a.set, "--out", a.folder,
                      {"explanation.json", "explanation.html", "instrument.json", "amended/measurement.json"});
  const data::Ranks mpi;
  const data::JsonValue root = data::load_json(data::measurement_file(a.set));
  if (data::curves::kind_of(root)) return run_curves(a, root);
  const data::MeasurementSet set = data::load_measurement(a.set);
  const FilledFolder folder(data::rank() == 0 ? a.folder : "");
  data::ExplainOptions explain_options;
  explain_options.threads = a.threads, explain_options.library = a.tries.empty();
  for (const std::string& words : a.tries) explain_options.tries.push_back(split(words, '+'));
  const TimedProgress progress(set.file + ": ", 60, 60);
  if (data::rank() == 0) explain_options.progress = progress;
  if (data::ranks() == 1) {
    stop_on_signals();
    explain_options.stop = going_on(progress);
  }
  const data::Explanation found = explain(set, explain_options);
  if (data::rank() != 0) return 0;
  show_progress("");
  write_found(a, set, found);
  if (a.json)
    fmt::print("{}", to_json(found));
  else
    print(found);
  return 0;
}

}  // namespace

Command explain_command() {
  return make_command("explain", "Fits a measured set, says what is left, and what an effect would change",
                      {"ostium explain my-wire -o found", "ostium explain my-tubes --try shaft_torsion -o found",
                       "ostium explain --template projections -o my-wire",
                       "mpirun -n 8 ostium explain my-tubes --try shaft_torsion[0] --threads 1 -o found"},
                      declare, run);
}

}  // namespace ostium::app
