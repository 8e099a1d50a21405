#include <fmt/format.h>

#include <cmath>

#include "core/base/units.h"
#include "data/formats/markup.h"
#include "data/formats/plot.h"
#include "data/identification/characterisation/characterisation_report.h"
#include "data/identification/report/explanation_style.h"

namespace ostium::data {

namespace {

using units::mm, units::Nmm2;

const std::string combined_colour = "#222222", declared_colour = "#bbbbbb";
const std::vector<std::string> set_colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};

std::string cell(const std::string& words) { return "<td class=\"n\">" + words + "</td>"; }

/// "40.1 ± 0.4", or what is declared.
std::string value_of(const Combined& n, double unit) {
  if (!n.measured()) return fmt::format("({:.4g})", n.value / unit);
  return fmt::format("{:.4g} &plusmn; {:.2g}", n.value / unit, n.value * n.sigma / unit);
}

std::string from(const Characterisation& c, const Combined& n) {
  std::string out;
  for (std::size_t i = 0; i < n.sets.size(); ++i)
    out += (i > 0 ? ", " : "") + escaped(c.sets[n.sets[i]].name) +
           (n.sets.size() > 1 ? fmt::format(" ({:+.1f})", n.off[i]) : "");
  return out.empty() ? "as declared" : out;
}

Plot::Points level(double from_m, double to_m, double value) {
  return {{from_m / mm, value / Nmm2}, {to_m / mm, value / Nmm2}};
}

/// One stiffness along the instrument: each set's, and all together with its error.
std::string along(const Characterisation& c, Stiffness of) {
  const bool EI = of == Stiffness::bending;
  Plot plot(EI ? "EI" : "GJ", "from the tip, mm", "N mm2", 470, 300);
  plot.y_from_zero();
  for (const DeclaredStretch& d : c.declared)
    plot.line(level(d.from_tip_m, d.to_tip_m, EI ? d.EI_N_m2 : d.GJ_N_m2), declared_colour, 3);
  for (std::size_t k = 0; k < c.sets.size(); ++k) {
    bool any = false;
    for (const StiffnessEstimate& e : c.sets[k].stiffness) {
      if (e.of != of) continue;
      for (const double by : {-e.sigma, e.sigma})
        plot.line(level(e.from_tip_m, e.to_tip_m, e.value_N_m2 * std::exp(by)), set_colours[k % set_colours.size()], 1,
                  "3 3");
      any = true;
    }
    if (any) plot.legend(c.sets[k].name, set_colours[k % set_colours.size()], false, "3 3");
  }
  for (const Stretch& s : c.wire.stretches) {
    const Combined& n = EI ? s.EI_N_m2 : s.GJ_N_m2;
    if (n.measured()) plot.line(level(s.from_tip_m, s.to_tip_m, n.value), combined_colour, 1.6);
  }
  plot.legend("declared", declared_colour), plot.legend("together", combined_colour);
  return plot.svg();
}

std::string stretches(const Characterisation& c) {
  std::string out =
      "<table><tr><th>from the tip, mm</th><th>EI, N mm&sup2;</th><th>from (off by, in standard errors)</th><th>GJ, N "
      "mm&sup2;</th><th>from</th></tr>\n";
  for (const Stretch& s : c.wire.stretches)
    out += "<tr>" + cell(fmt::format("{:g} to {:g}", s.from_tip_m / mm, s.to_tip_m / mm)) +
           cell(value_of(s.EI_N_m2, Nmm2)) + "<td>" + from(c, s.EI_N_m2) + "</td>" + cell(value_of(s.GJ_N_m2, Nmm2)) +
           "<td>" + from(c, s.GJ_N_m2) + "</td></tr>\n";
  out += "</table>\n";
  if (c.wire.friction.measured())
    out += "<p>Friction on the benches: " + value_of(c.wire.friction, 1) + ", from " + from(c, c.wire.friction) +
           ".</p>\n";
  return out;
}

std::string sets(const Characterisation& c) {
  std::string out =
      "<table><tr><th>set</th><th>kind</th><th>verdict by itself</th><th>effects</th><th>predicted by the others, over "
      "noise</th><th>beyond their errors</th></tr>\n";
  for (const CharacterisedSet& s : c.sets) {
    std::string effects;
    for (const std::string& id : s.effects()) effects += (effects.empty() ? "" : ", ") + id;
    const JsonValue* kind = s.root.find("kind");
    out += fmt::format("<tr{}><td>{}</td><td>{}</td><td>{}</td><td>{}</td>", s.used() ? "" : " class=\"weak\"",
                       escaped(s.name), kind ? escaped(kind->text) : "centrelines", to_string(s.verdict()),
                       escaped(effects)) +
           cell(s.check ? fmt::format("{:.2f}", s.check->over_noise) : "&ndash;") +
           cell(s.check
                    ? fmt::format("{:.2f}, {}", s.check->beyond_errors, s.check->agrees() ? "agrees" : "does not agree")
                    : "&ndash;") +
           "</tr>\n";
  }
  return out + "</table>\n";
}

}  // namespace

std::string to_html(const Characterisation& c) {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>Characterisation</title><style>";
  out += explanation_style;
  out += "</style></head><body>\n<h1>What the sets say together</h1>\n<ul>\n";
  for (const std::string& sentence : c.text) out += "<li>" + escaped(sentence) + "</li>\n";
  out += "</ul>\n<h2>Stiffness</h2>\n" + along(c, Stiffness::bending) + along(c, Stiffness::torsion) + stretches(c) +
         "<h2>The sets</h2>\n" + sets(c);
  return out +
         "<p class=\"source\">In brackets: as declared, not measured. Each set's own prior is taken out, and the sets "
         "are weighted by their errors. Made by ostium characterise. For training and research, not for decisions on a "
         "patient.</p>\n</body></html>\n";
}

}  // namespace ostium::data
