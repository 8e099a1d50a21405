#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/formats/markup.h"
#include "data/identification/report/explanation_plots.h"
#include "data/identification/report/explanation_report.h"
#include "data/identification/report/explanation_style.h"
#include "data/identification/report/law_report.h"

namespace ostium::data {

namespace {

std::string cell(const std::string& words) { return "<td class=\"n\">" + words + "</td>"; }
std::string number(const std::optional<double>& value, double unit = 1, const char* none = "&ndash;") {
  return value ? fmt::format("{:.3g}", *value / unit) : none;
}

std::string model_row(const FittedModel& m, const Explanation& x) {
  return "<tr><td>" + escaped(m.name) + "</td>" + cell(number(m.rms_m, x.unit.size)) +
         cell(number(m.rms_held_out_m, x.unit.size)) + cell(number(m.chi2_per_dof)) +
         cell(fmt::format("{:+.1f}", m.bic - x.declared.bic)) + "</tr>\n";
}

std::string models(const Explanation& x) {
  std::string out = fmt::format(
      "<table><tr><th>model</th><th>all data, {0}</th><th>held out, {0}</th><th>chi&sup2; per degree of "
      "freedom</th><th>BIC against declared</th></tr>\n",
      x.unit.name);
  out += "<tr><td>as declared, nothing fitted</td>" + cell(number(x.rms_nominal_m, x.unit.size)) + cell("") + cell("") +
         cell("") + "</tr>\n";
  out += model_row(x.declared, x);
  for (const FittedModel& c : x.candidates) out += model_row(c, x);
  return out + "</table>\n";
}

std::string parameters(const FittedModel& m) {
  std::string out =
      "<table><tr><th>parameter</th><th>value</th><th>standard error</th><th>unit</th><th>found in the "
      "data</th></tr>\n";
  for (const FittedParameter& p : m.parameters) {
    const std::string unit = p.parameter.unit == "1" ? "" : p.parameter.unit;
    out += fmt::format("<tr{}><td>{}</td>", p.informed < 0.5 ? " class=\"weak\"" : "", escaped(p.parameter.label)) +
           cell(fmt::format("{:.4g}", p.value)) + cell(fmt::format("{:.2g}", p.sigma)) + "<td>" + unit + "</td>" +
           cell(fmt::format("{:.0f} %", 100 * p.informed)) + "</tr>\n";
  }
  return out +
         "</table>\n<p class=\"source\">Found in the data: how far they, not what was expected before, decide a value. "
         "What they leave open is grey.</p>\n";
}

std::string residual_test_table(const FittedModel& m) {
  if (m.residual_tests.list.empty()) return "<p>Too few experiments to tell.</p>\n";
  std::string out = "<table><tr><th>the residual goes with</th><th>share</th><th></th><th>chance</th></tr>\n";
  for (const ResidualTest& d : m.residual_tests.list) {
    if (!d.significant && d.p_value > 0.2) continue;
    out += fmt::format(
        "<tr{}><td>{}</td><td class=\"n\">{:.0f} %</td><td><svg width=\"120\" height=\"10\"><rect width=\"{:.0f}\" "
        "height=\"10\" fill=\"{}\"/></svg></td><td class=\"n\">{:.2g}{}</td></tr>\n",
        d.significant ? "" : " class=\"weak\"", escaped(d.on), 100 * d.share, 120 * std::min(d.share, 1.0),
        d.significant ? "#d55e00" : "#ccc", d.p_value, d.significant ? "" : ", not significant");
  }
  return out +
         "</table>\n<p class=\"source\">Share of the residual's squares; chance of as large a share if it had nothing "
         "to do "
         "with it (permutations). Significant after allowing for how many were tried.</p>\n";
}

/// The laws of the first candidate that has any.
std::string laws(const Explanation& x) {
  const auto c =
      std::find_if(x.candidates.begin(), x.candidates.end(), [](const FittedModel& m) { return !m.laws.empty(); });
  if (c == x.candidates.end()) return "";
  std::string out = "<h2>What was learned with " + escaped(c->name) + "</h2>\n";
  for (const LearnedLaw& law : c->laws) out += law_plot(law);
  return out;
}

std::string plots(const MeasurementSet& set, const Explanation& x) {
  const auto any = [&](Experiment::Kind kind) {
    return std::any_of(set.experiments.begin(), set.experiments.end(),
                       [&](const Experiment& e) { return e.kind == kind; });
  };
  std::string out = "<h2>Measured and modelled</h2>\n";
  if (any(Experiment::Kind::centreline) || any(Experiment::Kind::tip))
    out += shapes_plot(set, x, 0) + shapes_plot(set, x, 1);
  if (any(Experiment::Kind::radius)) out += radius_plot(set, x);
  for (std::size_t v = 0; v < set.views.size(); ++v) out += view_plot(set, x, static_cast<int>(v));
  out += "<h2>What is left</h2>\n";
  if (any(Experiment::Kind::centreline) || any(Experiment::Kind::projections)) out += along_wire_plot(set, x);
  if (any(Experiment::Kind::tip)) out += tip_residual_plot(set, x, 0) + tip_residual_plot(set, x, 1);
  return out + experiments_plot(set, x);
}

}  // namespace

std::string to_html(const MeasurementSet& as_read, const Explanation& x) {
  const MeasurementSet& set = x.judged(as_read);
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>" +
      escaped(set.title) + "</title><style>" + explanation_style + "</style></head><body>\n";
  out += "<h1>" + escaped(set.title) + "</h1>\n<div class=\"source\">" + escaped(set.source) + "</div>\n";
  out += fmt::format("<div class=\"verdict {0}\"><b>{0}</b>: {1}</div>\n<ul>\n", to_string(x.verdict),
                     escaped(x.verdict_text[0]));
  for (std::size_t i = 1; i < x.verdict_text.size(); ++i) out += "<li>" + escaped(x.verdict_text[i]) + "</li>\n";
  out += "</ul>\n<h2>Models</h2>\n" + models(x) + laws(x) + plots(set, x);
  out += "<h2>What the residual of the declared model goes with</h2>\n" + residual_test_table(x.declared);
  for (const FittedModel& c : x.candidates)
    out += "<h2>What the residual with " + escaped(c.name) + " goes with</h2>\n" + residual_test_table(c);
  out += "<h2>Parameters of the declared model</h2>\n" + parameters(x.declared);
  for (const FittedModel& c : x.candidates) out += "<h2>Parameters with " + escaped(c.name) + "</h2>\n" + parameters(c);
  return out + "<p class=\"source\">" + sigma_is +
         " Made by ostium explain. For training and research, not for decisions on a "
         "patient.</p>\n</body></html>\n";
}

}  // namespace ostium::data
