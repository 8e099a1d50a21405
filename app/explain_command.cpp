#include "app/explain_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "data/formats/write_file.h"
#include "data/identification/measurement/measurement_reader.h"
#include "data/identification/report/explanation_report.h"
#include "data/identification/selection/explain.h"

namespace ostium {

namespace {

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> out;
  std::stringstream stream(text);
  for (std::string word; std::getline(stream, word, at);) out.push_back(word);
  return out;
}

std::string contents(const std::string& file) {
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void print(const Explanation& x) {
  fmt::print("verdict: {}\n", to_string(x.verdict));
  for (const std::string& sentence : x.verdict_text) fmt::print("  {}\n", sentence);
  fmt::print("\n{:<40} {:>12} {:>12} {:>10}  {}\n", "parameter", "value", "sigma", "from data", "unit");
  for (const FittedParameter& p : x.best().parameters)
    fmt::print("{:<40} {:>12.5g} {:>12.2g} {:>8.0f} %  {}\n", p.parameter.name, p.value, p.sigma, 100 * p.informed,
               p.parameter.unit == "1" ? "" : p.parameter.unit);
}

}  // namespace

int explain_command(const ExplainCommandOptions& options) {
  const Ranks mpi;
  const MeasurementSet set = load_measurement(options.set);
  ExplainOptions explain_options{{}, options.threads, {}, options.tries.empty()};
  for (const std::string& words : options.tries) explain_options.tries.push_back(split(words, '+'));
  const bool terminal = isatty(STDERR_FILENO);
  if (terminal && rank() == 0)
    explain_options.progress = [](const std::string& what) { fmt::print(stderr, "\r\033[K{}", what); };
  const Explanation found = explain(set, explain_options);
  if (rank() != 0) return 0;
  if (terminal) fmt::print(stderr, "\r\033[K");

  const std::filesystem::path folder(options.folder);
  write_file((folder / "explanation.json").string(), to_json(found));
  write_file((folder / "explanation.html").string(), to_html(set, found));
  write_file((folder / "amended" / "measurement.json").string(), amended(contents(set.file), set, found));
  for (std::size_t i = 0; i < set.instruments.size(); ++i) {
    const bool one = set.instruments.size() == 1, innermost = i + 1 == set.instruments.size();
    const std::string text = instrument_json(set, found, i);
    write_file((folder / (one ? "instrument.json" : fmt::format("instrument-{}.json", i))).string(), text);
    if (innermost && !options.instrument.empty()) write_file(options.instrument, text);
  }
  if (options.json)
    fmt::print("{}", to_json(found));
  else
    print(found);
  return 0;
}

}  // namespace ostium
