#include <fmt/format.h>

#include <filesystem>

#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/filled_folder.h"
#include "app/command_line/interrupt.h"
#include "app/command_line/progress.h"
#include "core/base/units.h"
#include "data/catalogue/catalogue.h"
#include "data/catalogue/instrument/instrument_reader.h"
#include "data/formats/load_error.h"
#include "data/formats/write_file.h"
#include "data/identification/characterisation/characterisation_report.h"
#include "data/identification/curves/curve_report.h"
#include "data/identification/report/explanation_report.h"

namespace ostium::app {

namespace {

struct Arguments {
  std::vector<std::string> sets;  ///< folders, or their measurement.json, of one instrument
  std::string file;               ///< where the instrument goes
  std::string like;               ///< instrument that gives what was not measured; empty: the first set of shapes
  std::string folder;  ///< where characterisation.json, the page and each set's explanation go; empty: nowhere
  int threads = 0;     ///< 0: one for each core
  bool json = false;
};

void declare(Options& options, Arguments& a) {
  options.add("sets", a.sets, "Sets of one instrument: their folders, or measurement.json").type("SET...").required();
  options.add("-o,--out", a.file, "The instrument as it was found, for ostium run, predict --with and the catalogue")
      .type("FILE.json")
      .required()
      .writes();
  options
      .add("--like", a.like,
           "An instrument of the catalogue, or its file: weight, sizes and what else is not measured; without, the "
           "first set of shapes gives them")
      .type("NAME|FILE");
  options.add("--report", a.folder, "Where characterisation.json, characterisation.html and each set's findings go")
      .type("DIR");
  options.add("--threads", a.threads, "Threads; 0: one for each core").range(0, 1024);
  options.flag("--json", a.json, "Print characterisation.json, see data/schemas/characterisation.schema.json");
}

using units::mm, units::Nmm2;

std::string value_of(const data::Combined& n) {
  if (!n.measured()) return fmt::format("({:.4g})", n.value / Nmm2);
  return fmt::format("{:.4g} +- {:.2g}", n.value / Nmm2, n.value * n.sigma / Nmm2);
}

void print(const data::Characterisation& c) {
  for (const std::string& sentence : c.text) fmt::print("{}\n", sentence);
  fmt::print("\n{:<24} {:<18} {:<16} {}\n", "set", "kind", "verdict", "effects");
  for (const data::CharacterisedSet& s : c.sets) {
    const data::JsonValue* kind = s.root.find("kind");
    fmt::print("{:<24} {:<18} {:<16} {}\n", s.name, kind ? kind->text : "centrelines", to_string(s.verdict()),
               fmt::join(s.effects(), ", "));
  }
  fmt::print("\n{:<24} {:>20} {:>20}\n", "from the tip, mm", "EI, N mm2", "GJ, N mm2");
  for (const data::Stretch& s : c.wire.stretches)
    fmt::print("{:<24} {:>20} {:>20}\n", fmt::format("{:g} to {:g}", s.from_tip_m / mm, s.to_tip_m / mm),
               value_of(s.EI_N_m2), value_of(s.GJ_N_m2));
  if (const data::Combined& n = c.wire.friction; n.measured())
    fmt::print("friction on the benches: {:.3g} +- {:.2g}\n", n.value, n.value * n.sigma);
  fmt::print("In brackets: as declared, not measured.\n");
}

void add_report(const data::Characterisation& c, const std::filesystem::path& folder,
                std::vector<data::FileText>& files) {
  for (const data::CharacterisedSet& s : c.sets) {
    const std::filesystem::path of = folder / s.name;
    if (const auto* x = std::get_if<data::Explanation>(&s.found)) {
      if (x->verdict_text.empty()) continue;  // it was not reached
      files.push_back({(of / "explanation.json").string(), to_json(*x)});
      files.push_back({(of / "explanation.html").string(), to_html(s.shapes, *x)});
    } else {
      const auto& found = std::get<data::curves::CurveExplanation>(s.found);
      files.push_back({(of / "explanation.json").string(), to_json(found)});
      files.push_back({(of / "explanation.html").string(), to_html(found)});
    }
  }
  files.push_back({(folder / "characterisation.json").string(), to_json(c)});
  files.push_back({(folder / "characterisation.html").string(), to_html(c)});
}

/// What is named twice would count as measured twice: its error would shrink, and it would agree with itself.
void require_different(const std::vector<std::string>& sets) {
  const auto file_of = [](const std::filesystem::path& set) {
    std::error_code unseen;
    return std::filesystem::is_directory(set, unseen) ? set / "measurement.json" : set;
  };
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      std::error_code unseen;
      if (std::filesystem::equivalent(file_of(sets[j]), file_of(sets[i]), unseen))
        throw data::LoadError(fmt::format("{} and {} are one set; expected each set once", sets[j], sets[i]));
    }
}

int run(const Arguments& a) {
  require_ending(a.file, {".json"});
  require_different(a.sets);
  for (const std::string& set : a.sets) require_not_of_set(set, "--out", a.file);
  std::string like;
  if (!a.like.empty()) {
    const std::string file = data::instrument_file(a.like);
    data::load_instrument(file);
    like = to_json(data::load_json(file));
  }
  const FilledFolder folder(a.folder);
  data::CharacteriseOptions options;
  options.threads = a.threads;
  options.progress = TimedProgress("", 60, 60);
  stop_on_signals();
  options.stop = [] { return interrupted.load(); };
  const data::Characterisation found = data::characterise(a.sets, like, options);
  show_progress("");
  std::vector<data::FileText> files = {{a.file, instrument_json(found, std::filesystem::path(a.file).stem().string())}};
  if (!a.folder.empty()) add_report(found, a.folder, files);
  data::write_files(files);
  if (a.json)
    fmt::print("{}", to_json(found));
  else
    print(found);
  return 0;
}

}  // namespace

Command characterise_command() {
  return make_command("characterise", "One instrument's stiffness and friction from several measured sets together",
                      {"ostium characterise bend torque views -o my-wire.json",
                       "ostium characterise bend torque --like wire-014-workhorse -o my-wire.json --report found",
                       "ostium predict push --with my-wire.json"},
                      declare, run);
}

}  // namespace ostium::app
