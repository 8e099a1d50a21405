#include "app/commands/explain_curves.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/command_line/progress.h"
#include "data/formats/write_file.h"
#include "data/identification/curves/curve_report.h"
#include "data/identification/curves/kinds.h"
#include "data/identification/curves/set/run_table.h"

namespace ostium::app {

namespace {

void print(const data::curves::CurveExplanation& x) {
  fmt::print("verdict: {}\n", to_string(x.verdict));
  for (const std::string& sentence : x.text) fmt::print("  {}\n", sentence);
  if (!x.next.empty()) fmt::print("  To measure next: {}.\n", x.next);
  fmt::print("\n{:<40} {:>12} {:>12} {:>10}  {}\n", "parameter", "value", "sigma", "from data", "unit");
  for (const data::curves::Fitted& f : x.best().parameters)
    fmt::print("{:<40} {:>12.5g} {:>12.2g} {:>8.0f} %  {}\n", f.label, f.value, f.sigma, 100 * f.informed,
               f.parameter.unit == "1" ? "" : f.parameter.unit);
  fmt::print("{}\n", data::sigma_is);
}

}  // namespace

void explain_curves(const data::JsonValue& file, const data::curves::CurveOptions& options, const std::string& to,
                    bool json) {
  const data::JsonValue root = data::curves::with_tables(file);
  const data::curves::CurveExplanation found = data::curves::explain_curves(root, options);
  show_progress("");
  const std::filesystem::path folder(to);
  data::write_files({{(folder / "explanation.json").string(), to_json(found)},
                     {(folder / "explanation.html").string(), to_html(found)},
                     {(folder / "amended" / "measurement.json").string(), amended(root, found)}});
  if (json)
    fmt::print("{}", to_json(found));
  else
    print(found);
}

void predict_curves(const data::JsonValue& file, const std::string& to, bool json) {
  const data::JsonValue root = data::curves::with_tables(file);
  const auto set = data::curves::read_set(root);
  for (const std::string& doubt : data::curves::doubts_of_tables(root))
    fmt::print(stderr, "ostium predict: {}\n", doubt);
  const std::string text = prediction_json(*set);
  const std::filesystem::path folder(to);
  data::write_files(
      {{(folder / "prediction.json").string(), text}, {(folder / "prediction.csv").string(), prediction_csv(*set)}});
  if (json) {
    fmt::print("{}", text);
    return;
  }
  std::vector<double> free;
  for (const data::EffectParameter& p : set->free()) free.push_back(p.prior);
  const auto predicted = set->predict(free, {});
  fmt::print("{:<24} {:<16} {:>12}\n", "run", "measured", "off by");
  for (std::size_t r = 0; r < predicted.size(); ++r)
    for (std::size_t c = 0; c < predicted[r].size(); ++c) {
      const data::curves::Channel& channel = set->runs()[r].channels[c];
      const Eigen::VectorXd off = predicted[r][c] - channel.measured;
      fmt::print("{:<24} {:<16} {:>12.4g} {}\n", set->runs()[r].id, channel.label,
                 std::sqrt(off.squaredNorm() / static_cast<double>(off.size())), channel.unit);
    }
}

}  // namespace ostium::app
