#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "data/formats/csv.h"
#include "data/study/study_page.h"

namespace ostium::data {

namespace {

using Json = nlohmann::ordered_json;

std::string field_of(double x) { return std::isfinite(x) ? fmt::format("{:.9g}", x) : ""; }
Json json_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

const GroupPair* pair_of(const ComparedMetric& m, std::size_t a, std::size_t b) {
  for (const GroupPair& pair : m.pairs)
    if (pair.a == a && pair.b == b) return &pair;
  return nullptr;
}

Json json_of(const Study& study, const ComparedMetric& m) {
  Json out = {{"metric", m.name}, {"groups", Json::array()}, {"pairs", Json::array()}, {"agreement", nullptr}};
  for (std::size_t g = 0; g < m.groups.size(); ++g) {
    Json by_trial = Json::array();
    for (const double median : m.by_trial[g]) by_trial.push_back(json_or_null(median));
    out["groups"].push_back({{"group", study.groups[g]},
                             {"participants", m.groups[g].values.size()},
                             {"median", json_or_null(m.groups[g].median)},
                             {"quartiles", {json_or_null(m.groups[g].low), json_or_null(m.groups[g].high)}},
                             {"by_trial", by_trial}});
  }
  for (const GroupPair& pair : m.pairs)
    out["pairs"].push_back({{"groups", {study.groups[pair.a], study.groups[pair.b]}},
                            {"u", pair.test.u},
                            {"superiority", pair.test.superiority},
                            {"p", pair.test.p},
                            {"exact", pair.test.exact},
                            {"holm_p", pair.holm}});
  if (m.agreement)
    out["agreement"] = {{"icc", m.agreement->icc},
                        {"interval", {json_or_null(m.agreement->low), json_or_null(m.agreement->high)}},
                        {"consistency", m.agreement->consistency},
                        {"participants", m.agreement->participants},
                        {"trials", m.agreement->trials}};
  return out;
}

}  // namespace

std::string study_csv(const Study& study, const std::vector<ComparedCase>& compared) {
  std::string out = "case,metric";
  const std::size_t groups = study.groups.size();
  for (const std::string& group : study.groups)
    for (const char* of : {"n", "median", "lower_quartile", "upper_quartile"}) out += "," + csv_field(group + " " + of);
  for (std::size_t a = 0; a < groups; ++a)
    for (std::size_t b = a + 1; b < groups; ++b)
      for (const char* of : {"U", "superiority", "p", "holm_p"})
        out += "," + csv_field(fmt::format("{} and {} {}", study.groups[a], study.groups[b], of));
  out += ",icc,icc_low,icc_high,icc_participants,icc_trials\n";
  for (const ComparedCase& c : compared)
    for (const ComparedMetric& m : c.metrics) {
      out += csv_field(c.case_name) + "," + csv_field(m.name);
      for (const GroupNumbers& g : m.groups)
        out += fmt::format(",{},{},{},{}", g.values.size(), field_of(g.median), field_of(g.low), field_of(g.high));
      for (std::size_t a = 0; a < groups; ++a)
        for (std::size_t b = a + 1; b < groups; ++b)
          if (const GroupPair* pair = pair_of(m, a, b))
            out += fmt::format(",{},{},{},{}", field_of(pair->test.u), field_of(pair->test.superiority),
                               field_of(pair->test.p), field_of(pair->holm));
          else
            out += ",,,,";
      out += m.agreement ? fmt::format(",{},{},{},{},{}\n", field_of(m.agreement->icc), field_of(m.agreement->low),
                                       field_of(m.agreement->high), m.agreement->participants, m.agreement->trials)
                         : ",,,,,\n";
    }
  return out;
}

std::string study_json(const Study& study, const std::vector<ComparedCase>& compared) {
  Json out = {
      {"schema", "ostium-study/1"}, {"groups", Json::array()}, {"cases", Json::array()}, {"statements", Json::array()}};
  for (const std::string& group : study.groups) {
    std::size_t people = 0;
    for (const Participant& p : study.participants) people += p.group == group;
    out["groups"].push_back({{"group", group}, {"participants", people}});
  }
  for (const ComparedCase& c : compared) {
    Json metrics = Json::array();
    for (const ComparedMetric& m : c.metrics) metrics.push_back(json_of(study, m));
    out["cases"].push_back(
        {{"case", c.case_name}, {"trials", c.trials}, {"metrics", metrics}, {"same_everywhere", c.same_everywhere}});
  }
  for (const AnsweredStatement& s : statements_of(study)) {
    Json counts = Json::object();
    for (std::size_t g = 0; g < study.groups.size(); ++g) counts[study.groups[g]] = s.counts[g];
    out["statements"].push_back(
        {{"part", s.part}, {"statement", s.statement}, {"counts", counts}, {"median", s.median}});
  }
  return out.dump(2) + "\n";
}

}  // namespace ostium::data
