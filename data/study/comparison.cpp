#include "data/study/comparison.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/quantile.h"

namespace ostium::data {

namespace {

/// The runs of one case, by participant and trial.
struct Trials {
  std::vector<std::map<int, const StudyRun*>> of;  ///< [participant]
  int most = 0, common = 0;  ///< trials that anybody made; that at least half of those who made any made
};

Trials trials_of(const Study& study, const std::string& case_name) {
  Trials out;
  out.of.resize(study.participants.size());
  for (const StudyRun& run : study.runs)
    if (run.case_name == case_name) out.of[run.participant][run.trial] = &run, out.most = std::max(out.most, run.trial);
  const auto made_all = [&](const auto& own, int trials) {
    for (int t = 1; t <= trials; ++t)
      if (!own.contains(t)) return false;
    return true;
  };
  const auto some = std::ranges::count_if(out.of, [](const auto& own) { return !own.empty(); });
  for (int trials = 1; trials <= out.most; ++trials)
    if (2 * std::ranges::count_if(out.of, [&](const auto& own) { return made_all(own, trials); }) >= some)
      out.common = trials;
  return out;
}

GroupNumbers numbers_of(const Study& study, const Trials& trials, std::size_t metric, const std::string& group) {
  GroupNumbers out;
  for (std::size_t p = 0; p < study.participants.size(); ++p) {
    if (study.participants[p].group != group) continue;
    std::vector<double> own;
    for (const auto& [trial, run] : trials.of[p])
      if (std::isfinite(run->values[metric])) own.push_back(run->values[metric]);
    if (!own.empty()) out.values.push_back(core::quantile(own, 0.5));
  }
  out.median = core::quantile(out.values, 0.5), out.low = core::quantile(out.values, 0.25),
  out.high = core::quantile(out.values, 0.75);
  return out;
}

std::optional<Agreement> agreement_of(const Trials& trials, std::size_t metric) {
  std::vector<std::vector<double>> rows;
  for (const auto& own : trials.of) {
    std::vector<double> row;
    for (const auto& [trial, run] : own)
      if (trial <= trials.common && std::isfinite(run->values[metric])) row.push_back(run->values[metric]);
    if (static_cast<int>(row.size()) == trials.common) rows.push_back(row);
  }
  if (trials.common < 2 || rows.size() < 2) return std::nullopt;
  const Agreement found = agreement(rows);
  return std::isfinite(found.icc) ? std::optional(found) : std::nullopt;
}

std::vector<double> medians_by_trial(const Study& study, const Trials& trials, std::size_t metric,
                                     const std::string& group) {
  std::vector<double> out;
  for (int trial = 1; trial <= trials.most; ++trial) {
    std::vector<double> values;
    for (std::size_t p = 0; p < study.participants.size(); ++p)
      if (const auto run = trials.of[p].find(trial); study.participants[p].group == group &&
                                                     run != trials.of[p].end() &&
                                                     std::isfinite(run->second->values[metric]))
        values.push_back(run->second->values[metric]);
    out.push_back(core::quantile(values, 0.5));
  }
  return out;
}

bool differs(const Study& study, const std::string& case_name, std::size_t metric) {
  std::optional<double> first;
  for (const StudyRun& run : study.runs) {
    if (run.case_name != case_name || !std::isfinite(run.values[metric])) continue;
    if (first && *first != run.values[metric]) return true;
    first = run.values[metric];
  }
  return false;
}

void correct(std::vector<ComparedMetric>& metrics) {
  std::vector<double> p;
  for (const ComparedMetric& metric : metrics)
    for (const GroupPair& pair : metric.pairs) p.push_back(pair.test.p);
  const std::vector<double> corrected = holm(p);
  auto next = corrected.begin();
  for (ComparedMetric& metric : metrics)
    for (GroupPair& pair : metric.pairs) pair.holm = *next++;
}

ComparedMetric compared(const Study& study, const Trials& trials, std::size_t metric) {
  ComparedMetric out{.name = study.metrics[metric], .groups = {}, .pairs = {}, .agreement = {}, .by_trial = {}};
  for (const std::string& group : study.groups) {
    out.groups.push_back(numbers_of(study, trials, metric, group));
    out.by_trial.push_back(medians_by_trial(study, trials, metric, group));
  }
  for (std::size_t a = 0; a < out.groups.size(); ++a)
    for (std::size_t b = a + 1; b < out.groups.size(); ++b)
      if (!out.groups[a].values.empty() && !out.groups[b].values.empty())
        out.pairs.push_back({a, b, rank_test(out.groups[a].values, out.groups[b].values)});
  out.agreement = agreement_of(trials, metric);
  return out;
}

}  // namespace

std::vector<ComparedCase> compare(const Study& study) {
  std::vector<ComparedCase> out;
  for (const std::string& case_name : study.cases) {
    const Trials trials = trials_of(study, case_name);
    ComparedCase one{.case_name = case_name, .trials = trials.most, .metrics = {}, .same_everywhere = {}};
    for (std::size_t metric = 0; metric < study.metrics.size(); ++metric)
      if (differs(study, case_name, metric))
        one.metrics.push_back(compared(study, trials, metric));
      else
        one.same_everywhere.push_back(study.metrics[metric]);
    correct(one.metrics);
    out.push_back(std::move(one));
  }
  return out;
}

std::vector<AnsweredStatement> statements_of(const Study& study) {
  std::vector<AnsweredStatement> out;
  for (const StudyAnswer& answer : study.answers) {
    if (answer.answer == 0) continue;
    auto found = std::ranges::find_if(
        out, [&](const auto& s) { return s.part == answer.part && s.statement == answer.statement; });
    if (found == out.end()) {
      out.push_back({answer.part, answer.statement, std::vector(study.groups.size(), std::vector<int>(5, 0))});
      found = std::prev(out.end());
    }
    const auto group = std::ranges::find(study.groups, study.participants[answer.participant].group);
    ++found
          ->counts[static_cast<std::size_t>(group - study.groups.begin())][static_cast<std::size_t>(answer.answer - 1)];
  }
  for (AnsweredStatement& statement : out) {
    std::vector<double> all;
    for (const std::vector<int>& counts : statement.counts)
      for (int k = 0; k < 5; ++k)
        all.insert(all.end(), static_cast<std::size_t>(counts[static_cast<std::size_t>(k)]), k + 1);
    statement.median = core::quantile(all, 0.5);
  }
  return out;
}

}  // namespace ostium::data
