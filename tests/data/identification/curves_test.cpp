/// Sets of curves by solvers of their own: what is declared is enough, effects and mistakes are named.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "data/catalogue/catalogue.h"
#include "data/identification/curves/curve_report.h"
#include "data/identification/curves/kinds.h"
#include "data/identification/curves/set/run_table.h"
#include "data/identification/curves/three_point_bend/three_point_bend.h"
#include "tests/data/refusals.h"
#include "tests/support/sets/bench_set.h"

namespace ostium::data {
namespace {

using curves::CurveExplanation;

synthetic::BenchSet made(const std::string& kind, const std::string& content, double size, unsigned seed) {
  for (const synthetic::BenchKind& k : synthetic::bench_kinds())
    if (k.name == kind) return k.make(content, size, seed);
  throw std::runtime_error("no generator of " + kind);
}

CurveExplanation explained(const std::string& text) { return curves::explain_curves(parse_json("set.json", text), {}); }

TEST(Curves, WhatIsDeclaredIsEnough) {
  const CurveExplanation x = explained(made("three_point_bend", "clean", 0, 101).json);
  EXPECT_EQ(to_string(x.verdict), "explained");
  EXPECT_NEAR(x.declared.model.rms(), 1, 0.15);
  EXPECT_TRUE(x.noise.as_declared);
}

TEST(Curves, NoiseThatNeighboursShareIsNoEffect) {
  const CurveExplanation x = explained(made("three_point_bend", "noise:shared", 0, 101).json);
  EXPECT_EQ(to_string(x.verdict), "explained");
  EXPECT_FALSE(x.noise.as_declared);
  EXPECT_GT(x.noise.channels[0].correlation, 0.4);
}

TEST(Curves, AnEffectIsNamedAndWhatIsAmendedPredictsIt) {
  const synthetic::BenchSet set = made("three_point_bend", "span_error", 4, 101);
  const JsonValue root = parse_json("set.json", set.json);
  const CurveExplanation x = curves::explain_curves(root, {});
  EXPECT_EQ(to_string(x.verdict), "effect");
  EXPECT_EQ(x.best().effects, set.effects);
  EXPECT_GT(x.best().share_removed, 0.95);
  // The amended set, with nothing fitted, is as close to what was measured as the model that was found.
  const auto again = curves::read_set(parse_json("amended.json", amended(root, x)));
  std::vector<double> free;
  for (const EffectParameter& p : again->free()) free.push_back(p.prior);
  const auto predicted = again->predict(free, {});
  double squares = 0, count = 0;
  for (std::size_t r = 0; r < predicted.size(); ++r) {
    const curves::Channel& force = again->runs()[r].channels[0];
    squares += (force.measured - predicted[r][0]).cwiseQuotient(force.sigma).squaredNorm();
    count += static_cast<double>(force.measured.size());
  }
  EXPECT_NEAR(std::sqrt(squares / count), x.best().model.rms(), 1e-3);
}

TEST(Curves, ARunInAnotherUnitIsNamedWithItsMend) {
  const CurveExplanation x = explained(made("three_point_bend", "fault:gram_force", 0, 101).json);
  ASSERT_EQ(to_string(x.verdict), "effect");
  ASSERT_TRUE(x.best().fault);
  EXPECT_EQ(x.best().fault->id, "unit_error");
  EXPECT_NE(x.best().fault->what.find("gram-force"), std::string::npos) << x.best().fault->what;
}

TEST(Curves, WhatIsLeftOutIsNotCountedAsLeft) {
  auto file = nlohmann::ordered_json::parse(made("three_point_bend", "clean", 0, 101).json);
  for (auto& value : file["runs"][0]["force_N"]) value = 0;
  const CurveExplanation x = explained(file.dump());
  ASSERT_EQ(to_string(x.verdict), "effect");
  ASSERT_TRUE(x.best().fault);
  EXPECT_EQ(x.best().fault->id, "outlier_experiment");
  EXPECT_GT(x.declared.model.rms(), 5);
  EXPECT_NEAR(x.best().model.rms(), 1, 0.15);
}

/// A set whose column is multiplied in all runs.
CurveExplanation with_column(const char* kind, const std::string& key, double factor) {
  auto file = nlohmann::ordered_json::parse(made(kind, "clean", 0, 101).json);
  for (auto& run : file["runs"])
    for (auto& value : run[key]) value = value.get<double>() * factor;
  return explained(file.dump());
}

TEST(Curves, AColumnOfAllRunsInAnotherUnitOrOfTheOtherSignIsNamed) {
  struct {
    const char *kind, *key;
    double factor;
    const char *id, *what;
  } const wrong[] = {{"three_point_bend", "force_N", 101.972, "unit_error", "force_N of all runs is in gram-force"},
                     {"three_point_bend", "force_N", -1, "sign_error", "force_N of all runs has the other sign"},
                     {"torque_response", "distal_deg", -1, "sign_error", "distal_deg of all runs has the other sign"}};
  for (const auto& [kind, key, factor, id, what] : wrong) {
    const CurveExplanation x = with_column(kind, key, factor);
    EXPECT_EQ(to_string(x.verdict), "effect") << what;
    ASSERT_TRUE(x.best().fault) << what;
    EXPECT_EQ(x.best().fault->id, id);
    EXPECT_EQ(x.best().fault->what, what);
  }
}

TEST(Curves, TwoColumnsInAnotherUnitAreNamedTogether) {
  const CurveExplanation x = explained(made("torque_response", "fault:both_radians", 0, 101).json);
  EXPECT_EQ(to_string(x.verdict), "effect");
  ASSERT_TRUE(x.best().fault);
  EXPECT_EQ(x.best().fault->what, "proximal_deg and distal_deg of all runs are in radians");
}

TEST(Curves, SectionsThatOverlapAreRefused) {
  auto file = nlohmann::ordered_json::parse(made("three_point_bend", "clean", 0, 101).json);
  auto& sections = file["instruments"][0]["sections"];
  auto second = sections.back();
  second["from_tip_mm"][0] = second["from_tip_mm"][1].get<double>() - 1;
  second["from_tip_mm"][1] = second["from_tip_mm"][1].get<double>() + 100;
  sections.push_back(second);
  expect_words(refusal_of([&] { curves::read_set(parse_json("set.json", file.dump())); }),
               {"from_tip_mm", "where the one before it ends"});
}

TEST(Curves, ABeamOfSmallDeflectionIsEulersOwn) {
  three_point_bend::Setup setup;
  setup.EI_N_m2 = {40e-6}, setup.radius_m = 0.18e-3;
  three_point_bend::Pass pass;
  pass.span_m = 20e-3, pass.share = {{0, 1.0}};
  pass.displacement_m = Eigen::VectorXd::LinSpaced(10, 0.005e-3, 0.05e-3),
  pass.time_s = Eigen::VectorXd::LinSpaced(10, 0, 9);
  setup.passes = {pass};
  const Eigen::VectorXd F = three_point_bend::forces(setup)[0][0];
  for (Eigen::Index k = 0; k < F.size(); ++k)
    EXPECT_NEAR(F[k], 48 * 40e-6 / std::pow(20e-3, 3) * pass.displacement_m[k], 2e-4 * F[k]);
}

/// Every kind has a template: a small set with tables that is explained as it is.
TEST(Curves, TemplatesAreSetsThatAreExplained) {
  for (const curves::Kind& kind : curves::kinds()) {
    const auto file = std::filesystem::path(data_folder()) / "templates" / kind.name / "measurement.json";
    const JsonValue root = curves::with_tables(load_json(file.string()));
    EXPECT_EQ(root.find("kind")->text, kind.name);
    const CurveExplanation x = curves::explain_curves(root, {});
    EXPECT_EQ(to_string(x.verdict), "explained") << kind.name;
    EXPECT_NEAR(x.declared.model.rms(), 1, 0.2) << kind.name;
  }
}

/// A set of two runs, the first with its samples in a table.
class Tabled : public testing::Test {
 protected:
  Tabled() {
    std::filesystem::create_directories(folder_);
    file_ = nlohmann::ordered_json::parse(made("three_point_bend", "clean", 0, 101).json);
    auto& run = file_["runs"][0];
    table_ = "# made by a machine\nforce_N;time_s;displacement_mm\n";
    for (std::size_t k = 0; k < run["force_N"].size(); ++k)
      table_ +=
          run["force_N"][k].dump() + ";" + run["time_s"][k].dump() + ";" + run["displacement_mm"][k].dump() + "\n";
    for (const char* key : {"force_N", "time_s", "displacement_mm"}) run.erase(key);
    run["csv"] = "run 1.csv";
  }
  ~Tabled() override { std::filesystem::remove_all(folder_); }

  JsonValue read() const {
    std::ofstream(folder_ / "run 1.csv") << table_;
    std::ofstream(folder_ / "measurement.json") << file_.dump();
    return curves::with_tables(load_json((folder_ / "measurement.json").string()));
  }
  void expect_refused(const std::vector<std::string>& words) const {
    try {
      curves::read_set(read());
    } catch (const LoadError& error) {
      for (const std::string& word : words)
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
      return;
    }
    ADD_FAILURE() << "nothing was refused: " << words[0];
  }

  const std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / "ostium-tabled";
  nlohmann::ordered_json file_;
  std::string table_;
};

TEST_F(Tabled, ALastLineWithoutAnEndIsDoubted) {
  EXPECT_TRUE(curves::doubts_of_tables(read()).empty());
  table_.resize(table_.size() - 3);  // cut within its last number
  const CurveExplanation x = curves::explain_curves(read(), {});
  ASSERT_FALSE(x.warnings.empty());
  EXPECT_NE(x.warnings[0].find("run 1.csv:"), std::string::npos) << x.warnings[0];
  EXPECT_NE(x.warnings[0].find("may have been cut"), std::string::npos) << x.warnings[0];
}

TEST_F(Tabled, WhatSpreadsheetsLeaveEmptyIsNoPartOfThem) {
  const auto plain = curves::read_set(read());
  std::string wider;
  for (const char c : table_) wider += c == '\n' ? std::string(";;\n") : std::string(1, c);
  table_ = wider.replace(wider.find(" machine;;"), 10, " machine") + ";;;;\n;;;;\n";
  EXPECT_EQ(curves::read_set(read())->runs()[0].channels[0].measured, plain->runs()[0].channels[0].measured);
  table_ += "1;2;3;4;\n";
  EXPECT_THROW(read(), LoadError) << "a number in a column without a name";
}

TEST_F(Tabled, AreReadAsTheListsThatTheyStandFor) {
  const auto whole = curves::read_set(parse_json("set.json", made("three_point_bend", "clean", 0, 101).json));
  const auto tabled = curves::read_set(read());
  EXPECT_EQ(tabled->runs()[0].along, whole->runs()[0].along);
  EXPECT_EQ(tabled->runs()[0].channels[0].measured, whole->runs()[0].channels[0].measured);
}

TEST_F(Tabled, AreReadAsSpreadsheetsWriteThem) {
  const std::string table = table_.substr(table_.find('\n') + 1);
  const Eigen::VectorXd whole = curves::read_set(read())->runs()[0].along;
  table_ = "sep=;\r\n" + table;
  EXPECT_EQ(curves::read_set(read())->runs()[0].along, whole);
  table_ = table;
  std::replace(table_.begin(), table_.end(), '\n', '\r');
  EXPECT_EQ(curves::read_set(read())->runs()[0].along, whole);
}

TEST_F(Tabled, AreReadStrictly) {
  const std::string table = table_;
  const auto with = [&](const std::string& from, const std::string& to) {
    table_ = table;
    table_.replace(table_.find(from), from.size(), to);
  };
  with("force_N", "load_N"), expect_refused({"run 1.csv:2: runs[0].load_N is not a key"});
  with("force_N", "time_s"), expect_refused({"run 1.csv:2: column \"time_s\"", "before"});
  with("force_N", "force_N[1]"), expect_refused({"run 1.csv:2: column \"force_N[1]\"", "force_N[0]"});
  with("force_N", "Load [N]"), expect_refused({"run 1.csv:2: runs[0].Load [N] is not a key", "force_N"});
  table_ = table + "1;2\n", expect_refused({"run 1.csv:", "2 fields"});
  table_ = "Machine;4\n" + table, expect_refused({"run 1.csv:3: 3 fields", "header in line 1", "begins with #"});
  table_ = "1;2;3\n4;5;6\n", expect_refused({"run 1.csv:1: the first line has no names"});
  table_ = std::string("\xFF\xFE", 2) + table, expect_refused({"run 1.csv: is UTF-16; save it as UTF-8"});
  table_ = table + std::string("1;\0;2\n", 6), expect_refused({"run 1.csv:", "holds a byte 0"});
  table_ = table + "1;much;2\n", expect_refused({"run 1.csv:", "time_s is \"much\""});
  table_ = "time_s;displacement_mm\n1;2\n2;3\n3;4\n4;5\n", expect_refused({"runs[0].force_N is missing", "csv"});
  table_ = table, file_["runs"][0]["time_s"] = {1, 2, 3};
  expect_refused({"run 1.csv:2: column \"time_s\"", "itself"});
  file_["runs"][0].erase("time_s"), file_["runs"][0]["csv"] = "run 2.csv";
  expect_refused({"run 2.csv: cannot be read"});
}

TEST(Curves, BadInputIsNamed) {
  const std::string good = made("three_point_bend", "clean", 0, 101).json;
  const auto refused = [&](const std::function<void(nlohmann::json&)>& spoil) {
    auto file = nlohmann::json::parse(good);
    spoil(file);
    try {
      curves::read_set(parse_json("set.json", file.dump()));
    } catch (const LoadError& error) {
      return std::string(error.what());
    }
    return std::string("nothing was refused");
  };
  const auto says = [](const std::string& text, const std::string& what) {
    EXPECT_NE(text.find(what), std::string::npos) << text;
  };
  says(refused([](auto& f) { f["runs"][2]["force_N"].erase(3); }), "runs[2].force_N has 58 numbers; expected 59");
  says(refused([](auto& f) { f["runs"][1]["spam_mm"] = 20; }), "spam_mm");
  says(refused([](auto& f) { f["runs"][1]["id"] = f["runs"][0]["id"]; }), "runs[0] has it");
  says(refused([](auto& f) { f["runs"][1]["force_N"][4] = "much"; }), "runs[1].force_N[4]");
  says(refused([](auto& f) { f["runs"][0]["from_tip_mm"] = 5000; }), "sections of the instrument");
  says(refused([](auto& f) { f["kind"] = "four_point_bend"; }), "a kind of measurement");
  says(refused([](auto& f) {
         f["effects"] = {{{"id", "magic"}, {"parameters", nlohmann::json::object()}}};
       }),
       "an effect that can show in this set");
  says(refused([](auto& f) {
         f["effects"] = {{{"id", "support_friction"}, {"parameters", {{"friction", "0.2"}}}}};
       }),
       "effects[0].parameters.friction is \"0.2\"; expected a number");
}

/// Places of single values; of a list the first element stands for all.
void places_of(const nlohmann::json& value, const nlohmann::json::json_pointer& at,
               std::vector<nlohmann::json::json_pointer>& out) {
  out.push_back(at);
  if (value.is_object())
    for (const auto& [key, member] : value.items()) places_of(member, at / key, out);
  else if (value.is_array() && !value.empty())
    places_of(value[0], at / 0, out);
}

TEST(Curves, AValueOfAnotherSortIsRefusedWhereverItStands) {
  for (const synthetic::BenchKind& kind : synthetic::bench_kinds()) {
    const auto good = nlohmann::json::parse(kind.make("clean", 0, 1).json);
    std::vector<nlohmann::json::json_pointer> places;
    places_of(good, nlohmann::json::json_pointer(""), places);
    for (const auto& place : places)
      for (const char* other : {"\"0.004\"", "true", "[0.004]", "{}", "null"}) {
        auto file = good;
        auto& value = file[place];
        const auto put = nlohmann::json::parse(other);
        const std::string at = place.to_string();
        const bool may_be_null = at.starts_with("/noise") || at.find("stiffness_N") != std::string::npos;
        if (value.type() == put.type() || (put.is_null() && may_be_null)) continue;
        value = put;
        EXPECT_NE(refusal_of([&] { curves::read_set(parse_json("set.json", file.dump())); }), "accepted")
            << kind.name << ": " << other << " at " << place;
      }
  }
}

}  // namespace
}  // namespace ostium::data
