#include <fmt/format.h>

#include <algorithm>

#include "data/formats/markup.h"
#include "data/formats/plot.h"
#include "data/identification/curves/curve_report.h"
#include "data/identification/report/explanation_style.h"
#include "data/identification/report/law_report.h"

namespace ostium::data::curves {

namespace {

const std::string measured_colour = "#222222", before_colour = "#d55e00", after_colour = "#0072b2";
constexpr std::size_t most_plots = 24;

std::string cell(const std::string& words) { return "<td class=\"n\">" + words + "</td>"; }
std::string number(double value) { return fmt::format("{:.3g}", value); }

Plot::Points points(const Run& run, const Eigen::VectorXd& y) {
  Plot::Points out;
  for (Eigen::Index k = 0; k < y.size(); ++k) out.emplace_back(run.along[k], y[k]);
  return out;
}

/// A candidate's curve of one channel: what was measured without its misfit.
Eigen::VectorXd modelled(const Candidate& c, std::size_t r, std::size_t channel) {
  const Channel& measured = c.set->runs()[r].channels[channel];
  return measured.measured - c.model.misfits[r][channel].cwiseProduct(measured.sigma);
}

std::string laws(const CurveExplanation& x) {
  for (const Candidate& c : x.candidates) {
    if (c.laws.empty()) continue;
    std::string out = "<h2>What was learned with " + escaped(c.name) + "</h2>\n";
    for (const LearnedLaw& law : c.laws) out += law_plot(law);
    return out;
  }
  return "";
}

std::string plots(const CurveExplanation& x) {
  std::string out;
  std::size_t count = 0;
  for (std::size_t r = 0; r < x.set->runs().size(); ++r)
    for (std::size_t c = 0; c < x.set->runs()[r].channels.size(); ++c) {
      if (++count > most_plots) continue;
      const Run& run = x.set->runs()[r];
      const Channel& channel = run.channels[c];
      Plot plot(run.id, fmt::format("{}, {}", run.along_label, run.along_unit),
                fmt::format("{}, {}", channel.label, channel.unit), 300, 220);
      plot.dots(points(run, channel.measured), measured_colour, 1.2);
      plot.line(points(run, modelled(x.declared, r, c)), before_colour, 1.2);
      if (!x.candidates.empty()) plot.line(points(run, modelled(x.candidates[0], r, c)), after_colour, 1.2);
      if (count == 1) {
        plot.legend("measured", measured_colour, true);
        plot.legend("declared", before_colour);
        if (!x.candidates.empty()) plot.legend("with effect", after_colour);
      }
      out += plot.svg();
    }
  if (count > most_plots) out += fmt::format("<p class=\"source\">The first {} of {} curves.</p>\n", most_plots, count);
  return out;
}

std::string row(const Candidate& c, double declared_bic) {
  return "<tr><td>" + escaped(c.name) + "</td>" + cell(number(c.model.rms())) +
         cell(c.model.held_out ? number(*c.model.held_out) : "&ndash;") + cell(number(c.model.per_freedom())) +
         cell(fmt::format("{:.0f} %", 100 * c.share_removed)) + cell(fmt::format("{:+.1f}", c.bic() - declared_bic)) +
         "</tr>\n";
}

std::string models(const CurveExplanation& x) {
  std::string out =
      "<table><tr><th>model</th><th>residual over noise</th><th>held out, over noise</th><th>chi&sup2; per degree of "
      "freedom</th><th>of the excess removed</th><th>BIC against declared</th></tr>\n";
  out += row(x.declared, x.declared.bic());
  for (const Candidate& c : x.candidates) out += row(c, x.declared.bic());
  return out + "</table>\n";
}

std::string parameter_table(const Candidate& c) {
  std::string out =
      "<table><tr><th>parameter</th><th>value</th><th>standard error</th><th>unit</th><th>found in the "
      "data</th></tr>\n";
  for (const Fitted& f : c.parameters)
    out += fmt::format("<tr{}><td>{}</td>", f.informed < 0.5 ? " class=\"weak\"" : "", escaped(f.parameter.what)) +
           cell(fmt::format("{:.4g}", f.value)) + cell(fmt::format("{:.2g}", f.sigma)) + "<td>" +
           (f.parameter.unit == "1" ? "" : escaped(f.parameter.unit)) + "</td>" +
           cell(fmt::format("{:.0f} %", 100 * f.informed)) + "</tr>\n";
  return out + "</table>\n";
}

}  // namespace

std::string to_html(const CurveExplanation& x) {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>" +
      escaped(x.set->title) + "</title><style>" + explanation_style + "</style></head><body>\n";
  out += "<h1>" + escaped(x.set->title) + "</h1>\n<div class=\"source\">" + escaped(x.set->source) + "</div>\n";
  out +=
      fmt::format("<div class=\"verdict {0}\"><b>{0}</b>: {1}</div>\n<ul>\n", to_string(x.verdict), escaped(x.text[0]));
  for (std::size_t i = 1; i < x.text.size(); ++i) out += "<li>" + escaped(x.text[i]) + "</li>\n";
  if (!x.next.empty()) out += "<li>To measure next: " + escaped(x.next) + ".</li>\n";
  out += "</ul>\n<h2>Models</h2>\n" + models(x) + laws(x) + "<h2>Measured and modelled</h2>\n" + plots(x);
  out += "<h2>Parameters of the declared model</h2>\n" + parameter_table(x.declared);
  for (const Candidate& c : x.candidates)
    out += "<h2>Parameters with " + escaped(c.name) + "</h2>\n" + parameter_table(c);
  return out + "<p class=\"source\">" + sigma_is +
         " Made by ostium explain. For training and research, not for decisions on a "
         "patient.</p>\n</body></html>\n";
}

}  // namespace ostium::data::curves
