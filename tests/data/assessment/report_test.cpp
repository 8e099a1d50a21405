#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "data/assessment/page.h"
#include "data/assessment/stages.h"
#include "data/formats/load_error.h"

namespace ostium::data {
namespace {

const std::string small = R"({ "schema": "ostium-scoring/1", "name": "small", "title": "Small", "note": "A test.",
  "items": [
    { "id": "1", "phase": "p", "kind": "step", "what": "drug first", "when": "w",
      "check": { "event": "heparin", "before": "inflation_begins" } },
    { "id": "2", "phase": "p", "kind": "error", "what": "too hard", "when": "w",
      "check": { "event": "over_pressure", "most": 0 } },
    { "id": "3", "phase": "p", "kind": "step", "what": "long enough", "when": "w",
      "check": { "metric": "procedure_time_s", "least": 5, "most": 20 } },
    { "id": "4", "phase": "p", "kind": "step", "what": "said so", "when": "a person listens" } ] })";

double code_number(EventCode c) { return static_cast<double>(c); }

RunRecord record_with(std::vector<double> events) {
  RunRecord r;
  r.step_s = 1e-3, r.steps = 10000;
  r.signal_columns = {"time_s", "heart_phase", "wire.inserted_mm"};
  for (int i = 0; i < 1000; ++i)
    for (const double v : {0.01 * i, 0.0, 0.1 * i}) r.signals.push_back(v);
  r.events = std::move(events);
  return r;
}

std::string report_refusal(const std::string& from, const std::string& to) {
  std::string text = small;
  text.replace(text.find(from), from.size(), to);
  try {
    read_score_list("folder/small.json", text);
  } catch (const LoadError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ScoreList, IsTickedByWhatTheRecordSays) {
  const ScoreList list = read_score_list("folder/small.json", small);
  const RunRecord good = record_with({1000, code_number(EventCode::heparin), -1, 5000,  //
                                      4000, code_number(EventCode::inflation_begins), -1, 0});
  const std::vector<Score> yes = score(list, good, metrics_of(good));
  ASSERT_EQ(yes.size(), 4u);
  EXPECT_EQ(yes[0].holds, Ticked::yes);
  EXPECT_EQ(yes[0].at_s, std::vector<double>{1.0});
  EXPECT_EQ(yes[1].holds, Ticked::yes) << "no such error";
  EXPECT_EQ(yes[2].holds, Ticked::yes) << yes[2].value;
  EXPECT_EQ(yes[3].holds, Ticked::not_seen) << "only a person can tell";

  const RunRecord bad = record_with({4000, code_number(EventCode::inflation_begins), -1, 0,  //
                                     5000, code_number(EventCode::over_pressure), -1, 22,    //
                                     6000, code_number(EventCode::heparin), -1, 5000,        //
                                     7000, code_number(EventCode::over_pressure), -1, 23});
  const std::vector<Score> no = score(list, bad, metrics_of(bad));
  EXPECT_EQ(no[0].holds, Ticked::no) << "too late";
  EXPECT_EQ(no[1].holds, Ticked::no);
  EXPECT_EQ(no[1].at_s, (std::vector<double>{5.0, 7.0})) << "every time";

  ScoreList both = list;
  both.items[1].kind = ScoreKind::step, both.items[1].check->least = 2, both.items[1].check->most = {};
  EXPECT_EQ(score(both, bad, metrics_of(bad))[1].at_s, std::vector<double>{7.0}) << "done with the second of two";

  const RunRecord none = record_with({});
  EXPECT_EQ(score(list, none, metrics_of(none))[0].holds, Ticked::not_seen) << "nothing was inflated";
}

TEST(ScoreList, AWayThroughTheVesselsIsInCentimetresAsListsSayIt) {
  ScoreList list = read_score_list("folder/small.json", small);
  list.items[2].check = ScoreCheck{};
  list.items[2].check->metric = "tip_reached_mm", list.items[2].check->least = 790;
  const auto said = [&](double mm) { return score(list, record_with({}), {{"tip_reached_mm", mm, "mm"}})[2].value; };
  EXPECT_EQ(said(822.4), "82.2 cm");
  EXPECT_EQ(said(3.2), "3.2 mm");
}

TEST(ScoreList, MistakesAreNamed) {
  const auto says = [](const std::string& what, const std::string& words) {
    EXPECT_NE(what.find(words), std::string::npos) << what;
  };
  says(report_refusal("\"heparin\"", "\"heparine\""), "small.json:4:");
  says(report_refusal("\"heparin\"", "\"heparine\""), "one of: script_step_begins");
  says(report_refusal("\"id\": \"2\"", "\"id\": \"1\""), "items[1].id is \"1\"; expected an id that no other item has");
  says(report_refusal("\"most\": 20", "\"most\": 4"), "items[2].check.most is 4; expected a number not below least");
  says(report_refusal("\"before\": \"inflation", "\"least\": 1, \"before\": \"inflation"), "expected an event, alone");
  says(report_refusal("\"procedure_time_s\"", "7"), "items[2].check.metric is 7");
  says(report_refusal("\"least\": 5", "\"least\": \"5\""), "items[2].check.least is \"5\"");
  says(report_refusal("\"procedure_time_s\"", "\"procedure_time\""), "small.json:8:");
  says(report_refusal("\"most\": 0", "\"mosst\": 0"), "mosst is not a key");
  says(report_refusal(", \"most\": 0 }", " }"), "no bound");
  says(report_refusal("\"event\": \"over_pressure\", ", ""), "an event or at a metric");
  says(report_refusal("\"name\": \"small\"", "\"name\": \"other\""), "the file's name");
}

TEST(ScoreList, TheOneThatShipsLoadsAndItsItemsAreTold) {
  const ScoreList list = find_score_list("pci-elective");
  std::set<std::string> ids;
  for (const ScoreItem& item : list.items) EXPECT_TRUE(ids.insert(item.id).second) << item.id;
  EXPECT_GE(std::count_if(list.items.begin(), list.items.end(), [](const ScoreItem& i) { return i.check.has_value(); }),
            15);
  EXPECT_THROW(find_score_list("no-such-list"), LoadError);
}

ReportRun run_with(const std::string& name) {
  ReportRun run;
  run.code = name, run.case_name = "a <case>", run.outcome = "success";
  run.record = record_with({1000, code_number(EventCode::mark), -1, 0});
  run.metrics = metrics_of(run.record);
  run.scores = score(read_score_list("folder/small.json", small), run.record, run.metrics);
  run.pictures = {{"a picture", {1, 2, 3}}};
  return run;
}

TEST(Report, NeedsNothingElseAndSaysWhatItIsFor) {
  const ScoreList list = read_score_list("folder/small.json", small);
  const std::string page = report_page({run_with("P1"), run_with("P2")}, list);
  EXPECT_NE(page.find("not for decisions on a patient"), std::string::npos);
  EXPECT_NE(page.find("a &lt;case&gt;"), std::string::npos) << "words are no markup";
  EXPECT_NE(page.find("data:image/png;base64,AQID"), std::string::npos);
  EXPECT_NE(page.find("P2, wire"), std::string::npos) << "both runs in one plot";
  for (const char* outside : {"http://", "https://", "src=\"/", "<link"})
    EXPECT_EQ(page.find(outside),
              page.find(outside) == std::string::npos ? std::string::npos : page.find("http://www.w3.org"))
        << outside;
}

TEST(Report, ShowsTheMonitorOfTheLastInflation) {
  ReportRun run = run_with("P1");
  EXPECT_EQ(report_page({run}, {}).find("The last inflation"), std::string::npos);
  run.record.signal_columns = {"time_s", "ecg_II_mV", "gauge_atm"};
  run.record.signals.clear();
  for (int i = 0; i < 1000; ++i)
    for (const double v : {0.01 * i, 0.1 * (i % 70), i > 400 ? 12.0 : 0.0}) run.record.signals.push_back(v);
  run.record.events = {4000, code_number(EventCode::inflation_begins), -1, 0,
                       6000, code_number(EventCode::deflated),         -1, 2};
  const std::string page = report_page({run}, {});
  const std::size_t at = page.find("The last inflation");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NE(page.find("II, mV", at), std::string::npos);
  EXPECT_NE(page.find("Gauge, atm", at), std::string::npos);
}

TEST(Report, TablesHaveARowEach) {
  const ScoreList list = read_score_list("folder/small.json", small);
  const std::string csv = report_csv({run_with("P1"), run_with("P2")}, list);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  const std::size_t columns =
      static_cast<std::size_t>(std::count(csv.begin(), csv.begin() + static_cast<long>(csv.find('\n')), ','));
  EXPECT_EQ(columns, 6 + metric_definitions().size() + 4);
  ReportRun run = run_with("");
  run.tools = {"wire"};
  run.marks = {"a mark, and what it says"};
  const std::string events = events_csv(run);
  EXPECT_EQ(events.find("time_s,event,tool,value,meaning,handling,text\n1.000,mark,"), 0u);
  EXPECT_NE(events.find(",\"a mark, and what it says\"\n"), std::string::npos);
  EXPECT_NE(report_page({run}, list).find("mark: a mark, and what it says"), std::string::npos);
}

TEST(Report, ErrorsOfHandlingAreListedWithTheirMeaning) {
  const ScoreList list = read_score_list("folder/small.json", small);
  ReportRun run = run_with("");
  EXPECT_NE(report_page({run}, list).find("No error of handling was found"), std::string::npos);
  run.tools = {"guide", "wire"};
  run.record.events = {2000, code_number(EventCode::side_branch_pushed), 1,  12.5,
                       3000, code_number(EventCode::stent_lost),         -1, 0};
  const std::string page = report_page({run}, list), csv = events_csv(run);
  EXPECT_EQ(page.find("No error of handling"), std::string::npos);
  EXPECT_NE(page.find("<td>error</td><td>side_branch_pushed</td><td>wire</td><td>12.5"), std::string::npos);
  EXPECT_NE(page.find("<td>critical</td><td>stent_lost</td>"), std::string::npos);
  EXPECT_NE(csv.find("2.000,side_branch_pushed,wire,12.5,mm inside,error,\n"), std::string::npos) << csv;
  const auto metric = [&](const std::string& name) {
    for (const Metric& m : metrics_of(run.record))
      if (m.name == name) return m.value;
    return -1.0;
  };
  EXPECT_NE(csv.find("3.000,stent_lost,,,,critical,\n"), std::string::npos) << csv;
  EXPECT_EQ(metric("handling_errors"), 2);
  EXPECT_EQ(metric("handling_errors_critical"), 1);
}

TEST(Report, FormsAskAndPromiseNothing) {
  const std::string page = questionnaire_page();
  EXPECT_NE(page.find("Participant code (no name)"), std::string::npos);
  EXPECT_NE(page.find("not for decisions on a patient"), std::string::npos);
}

/// What only one of them has, or has in another order, begins no stage.
TEST(Stages, AreWhatHappenedInAllRunsInOneOrder) {
  using enum EventCode;
  const auto run = [](std::vector<std::pair<EventCode, int>> what) {
    std::vector<double> events;
    double step = 0;
    for (const auto& [code, tool] : what)
      events.insert(events.end(), {step += 1000, code_number(code), static_cast<double>(tool), 0});
    ReportRun out;
    out.tools = {"guide", "wire"}, out.record = record_with(events), out.simulated_s = 10;
    return out;
  };
  const ReportRun expert =
      run({{tool_in, 0}, {heparin, -1}, {tool_in, 1}, {inflation_begins, -1}, {stent_deployed, -1}});
  const ReportRun novice = run({{heparin, -1},
                                {tool_in, 0},
                                {tool_in, 1},
                                {tool_out, 1},
                                {tool_in, 1},
                                {mark, -1},
                                {inflation_begins, -1},
                                {inflation_begins, -1}});
  const std::vector<Stage> stages = common_stages({expert, novice});
  std::vector<std::string> names;
  for (const Stage& stage : stages) names.push_back(stage.name);
  EXPECT_EQ(names, (std::vector<std::string>{"the run begins", "heparin", "wire in", "inflation"}));
  EXPECT_EQ(stages[1].begin_s, (std::vector<double>{2, 1}));
  EXPECT_EQ(stages[2].begin_s, (std::vector<double>{3, 3}));
  EXPECT_EQ(stages[3].begin_s, (std::vector<double>{4, 7}));
  EXPECT_EQ(common_stages({expert}).size(), 6U);
  const std::string page = report_page({expert, novice}, read_score_list("folder/small.json", small));
  EXPECT_NE(page.find("<td>wire in</td><td class=\"n\">0:03.0</td><td class=\"n\">1.0</td>"), std::string::npos);
  EXPECT_EQ(report_page({expert}, read_score_list("folder/small.json", small)).find("<h2>Stages"), std::string::npos);
}

}  // namespace
}  // namespace ostium::data
