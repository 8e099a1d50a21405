#include "data/study/study_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/quantile.h"
#include "data/assessment/html.h"
#include "data/assessment/metrics.h"
#include "data/formats/decimal.h"
#include "data/formats/markup.h"
#include "data/formats/plot.h"

namespace ostium::data {

namespace {

const char* const group_colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
const char* group_colour(std::size_t i) { return group_colours[i % std::size(group_colours)]; }
/// From "not at all" to "fully": apart in brightness as well as in hue.
const char* const of_answers[] = {"#b35806", "#f1a340", "#d8d8d8", "#92b4dd", "#2c5f9e"};

constexpr std::size_t most_plots = 12;

const MetricDefinition* definition_of(const std::string& metric) {
  for (const MetricDefinition& m : metric_definitions())
    if (m.name == metric) return &m;
  return nullptr;
}

std::string shown(double x) { return std::isfinite(x) ? fmt::format("{:.4g}", x) : ""; }
std::string p_text(double p) { return p < 0.001 ? "&lt; 0.001" : fmt::format("{:.3f}", p); }

/// What is known of a group: of numbers median and range, of words how often each.
std::string about_group(const Study& study, const std::string& group, std::size_t column) {
  std::vector<double> numbers;
  std::map<std::string, int> words;
  for (const Participant& p : study.participants)
    if (p.group == group && !p.about[column].empty()) {
      ++words[p.about[column]];
      if (const std::optional<double> x = decimal(p.about[column])) numbers.push_back(*x);
    }
  std::size_t answered = 0;
  for (const auto& [word, count] : words) answered += static_cast<std::size_t>(count);
  if (answered == 0) return "";
  if (numbers.size() == answered)
    return fmt::format("{:g} [{:g} to {:g}]", core::quantile(numbers, 0.5), std::ranges::min(numbers),
                       std::ranges::max(numbers));
  std::string out;
  for (const auto& [word, count] : words) out += fmt::format("{}{}: {}", out.empty() ? "" : ", ", escaped(word), count);
  return out;
}

std::string participants_table(const Study& study) {
  std::string out = "<table><tr><th>group</th><th>participants</th><th>runs</th><th>of these successful</th>";
  for (const std::string& about : study.about) out += "<th>" + escaped(about) + "</th>";
  out += "</tr>\n";
  for (const std::string& group : study.groups) {
    const auto in_group = [&](std::size_t p) { return study.participants[p].group == group; };
    const auto people = std::ranges::count(study.participants, group, &Participant::group);
    const auto runs = std::ranges::count_if(study.runs, [&](const StudyRun& r) { return in_group(r.participant); });
    const auto good = std::ranges::count_if(
        study.runs, [&](const StudyRun& r) { return in_group(r.participant) && r.outcome == "success"; });
    out += fmt::format("<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>",
                       escaped(group), people, runs, good);
    for (std::size_t c = 0; c < study.about.size(); ++c) out += "<td>" + about_group(study, group, c) + "</td>";
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

/// Least p that two groups of these sizes can show: one of all ways to share the participants out, on both sides.
double least_p(std::size_t n, std::size_t m) {
  double ways = 1;
  for (std::size_t k = 1; k <= n; ++k) ways *= static_cast<double>(m + k) / static_cast<double>(k);
  // Of groups of one size the other side is as likely; else, with ties, it may have nothing as far out.
  return std::min(1.0, (n == m ? 2 : 1) / ways);
}

std::string power_note(const Study& study) {
  std::string out;
  for (std::size_t a = 0; a < study.groups.size(); ++a)
    for (std::size_t b = a + 1; b < study.groups.size(); ++b) {
      const auto n = static_cast<std::size_t>(
                     std::ranges::count(study.participants, study.groups[a], &Participant::group)),
                 m = static_cast<std::size_t>(
                     std::ranges::count(study.participants, study.groups[b], &Participant::group));
      out += fmt::format(" {} and {} participants of {} and {} can show no p below {:.2g}.", n, m,
                         escaped(study.groups[a]), escaped(study.groups[b]), least_p(n, m));
    }
  return out;
}

std::string group_cell(const GroupNumbers& g) {
  return g.values.empty() ? "<td class=\"n open\">none</td>"
                          : fmt::format("<td class=\"n\">{} [{} to {}], {}</td>", shown(g.median), shown(g.low),
                                        shown(g.high), g.values.size());
}

std::string metric_row(const Study& study, const ComparedMetric& m) {
  const MetricDefinition* known = definition_of(m.name);
  std::string out = fmt::format("<tr><td>{}<br><span class=\"small\">{}</span></td>", escaped(m.name),
                                known ? escaped(known->definition) : "");
  for (const GroupNumbers& g : m.groups) out += group_cell(g);
  std::string pairs;
  for (const GroupPair& pair : m.pairs)
    pairs += fmt::format(
        "{}{}p {}{} (corrected {}), {:.0f} % above", pairs.empty() ? "" : "<br>",
        m.groups.size() > 2 ? escaped(study.groups[pair.a]) + " and " + escaped(study.groups[pair.b]) + ": " : "",
        p_text(pair.test.p), pair.test.exact ? "" : " (normal)", p_text(pair.holm), 100 * pair.test.superiority);
  out += "<td>" + pairs + "</td>";
  if (!m.agreement) return out + "<td class=\"n open\">cannot be told</td></tr>\n";
  const Agreement& agreed = *m.agreement;
  const std::string interval =
      std::isfinite(agreed.low) ? fmt::format("[{:.2f} to {:.2f}]", agreed.low, agreed.high) : "(no interval)";
  return out + fmt::format("<td class=\"n\">{:.2f} {}<br>{} in {} trials</td></tr>\n", agreed.icc, interval,
                           agreed.participants, agreed.trials);
}

double surest(const ComparedMetric& m) {
  double least = 2;
  for (const GroupPair& pair : m.pairs) least = std::min(least, pair.test.p);
  return least;
}

/// Each participant a dot, the groups side by side; or medians by trial, where there are several.
std::string metric_plot(const Study& study, const ComparedCase& c, const ComparedMetric& m) {
  const MetricDefinition* known = definition_of(m.name);
  Plot plot("", c.trials > 1 ? "trial" : "group", known && known->unit != "1" ? known->unit : "", 330, 210);
  for (std::size_t g = 0; g < m.groups.size(); ++g) {
    if (m.groups[g].values.empty()) continue;
    Plot::Points points;
    if (c.trials > 1)
      for (std::size_t t = 0; t < m.by_trial[g].size(); ++t) {
        if (std::isfinite(m.by_trial[g][t])) points.emplace_back(static_cast<double>(t + 1), m.by_trial[g][t]);
      }
    else
      for (const double value : m.groups[g].values) points.emplace_back(static_cast<double>(g + 1), value);
    if (c.trials > 1) plot.line(points, group_colour(g));
    plot.dots(points, group_colour(g), 3);
    plot.legend(study.groups[g], group_colour(g), true);
  }
  plot.y_from_zero();
  return "<figure class=\"plot\" style=\"width:340px\"><figcaption>" + escaped(m.name) + "</figcaption>" + plot.svg() +
         "</figure>\n";
}

std::string case_part(const Study& study, const ComparedCase& c) {
  std::vector<const ComparedMetric*> sorted;
  for (const ComparedMetric& m : c.metrics) sorted.push_back(&m);
  std::ranges::stable_sort(sorted, {}, [](const ComparedMetric* m) { return surest(*m); });
  std::string out = fmt::format("<h2>{}</h2>\n", escaped(c.case_name));
  for (std::size_t i = 0; i < std::min(most_plots, sorted.size()); ++i) out += metric_plot(study, c, *sorted[i]);
  out += "<table><tr><th>metric</th>";
  for (const std::string& group : study.groups) out += "<th>" + escaped(group) + ":<br>median [quartiles], n</th>";
  out += "<th>Mann-Whitney</th><th>ICC [95 %],<br>participants</th></tr>\n";
  for (const ComparedMetric* m : sorted) out += metric_row(study, *m);
  out += "</table>\n";
  if (!c.same_everywhere.empty()) {
    out += "<p class=\"small\">Without a difference between runs, or without a value: ";
    for (std::size_t i = 0; i < c.same_everywhere.size(); ++i) out += (i ? ", " : "") + escaped(c.same_everywhere[i]);
    out += ".</p>\n";
  }
  return out;
}

std::string answer_bar(const std::vector<int>& counts) {
  int all = 0;
  for (const int n : counts) all += n;
  if (all == 0) return "<span class=\"open\">no answer</span>";
  std::string out = "<svg width=\"300\" height=\"18\" role=\"img\" aria-label=\"";
  for (std::size_t k = 0; k < 5; ++k) out += fmt::format("{}{}: {}", k ? ", " : "", k + 1, counts[k]);
  out += "\">";
  double x = 0;
  for (std::size_t k = 0; k < 5; ++k) {
    const double wide = 300.0 * counts[k] / all;
    if (counts[k] == 0) continue;
    out +=
        fmt::format("<rect x=\"{:.1f}\" y=\"1\" width=\"{:.1f}\" height=\"16\" fill=\"{}\"/>", x, wide, of_answers[k]);
    out += fmt::format("<text x=\"{:.1f}\" y=\"13\" font-size=\"11\" text-anchor=\"middle\" fill=\"{}\">{}</text>",
                       x + wide / 2, k == 0 || k == 4 ? "#fff" : "#222", counts[k]);
    x += wide;
  }
  return out + "</svg>";
}

std::string answers_part(const Study& study) {
  const std::vector<AnsweredStatement> statements = statements_of(study);
  if (statements.empty()) return "";
  std::string out = "<h2>What they answered</h2>\n<p class=\"small\">From 1 (not at all) to 5 (fully):";
  for (std::size_t k = 0; k < 5; ++k)
    out += fmt::format(" <svg width=\"12\" height=\"12\"><rect width=\"12\" height=\"12\" fill=\"{}\"/></svg> {}",
                       of_answers[k], k + 1);
  out +=
      "; in each bar how many.</p>\n<table><tr><th>part</th><th>statement</th><th>group</th><th>answers</th>"
      "<th>median of all</th></tr>\n";
  for (const AnsweredStatement& s : statements)
    for (std::size_t g = 0; g < study.groups.size(); ++g)
      out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td class=\"n\">{}</td></tr>\n",
                         g ? "" : escaped(s.part), g ? "" : escaped(s.statement), escaped(study.groups[g]),
                         answer_bar(s.counts[g]), g ? "" : fmt::format("{:g}", s.median));
  out += "</table>\n";
  std::string remarks;
  for (const StudyAnswer& a : study.answers)
    if (!a.remark.empty())
      remarks += fmt::format("<li>{}: {} ({})</li>\n", escaped(study.participants[a.participant].code),
                             escaped(a.remark), escaped(a.statement));
  return remarks.empty() ? out : out + "<h2>Remarks</h2>\n<ul>\n" + remarks + "</ul>\n";
}

}  // namespace

std::string study_page(const Study& study, const std::vector<ComparedCase>& compared) {
  std::string body = participants_table(study);
  body +=
      "<p class=\"small\">Each participant counts once, with the median of his or her trials. p: exact, two-sided, of "
      "Mann and Whitney (ties included); corrected: by Holm for all metrics and groups of a case. \"Above\": the share "
      "of pairs in which the first group's value is the larger. ICC(2,1): of what differs between single trials, the "
      "share that lies between participants; below 0.5 a trial says little of the next." +
      power_note(study) + " A difference between groups is not yet what makes a score valid.</p>\n";
  for (const ComparedCase& c : compared) body += case_part(study, c);
  return html_page("Study", body + answers_part(study));
}

}  // namespace ostium::data
