/// Published examples, ways to choose counted one by one, and tables as people write them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>

#include "data/assessment/page.h"
#include "data/formats/load_error.h"
#include "data/study/study_page.h"

namespace ostium::data {
namespace {

/// Hollander and Wolfe (1973), Nonparametric Statistical Methods, p. 69: permeability of the human chorioamnion at term
/// and at 12 to 26 weeks; U = 35, two-sided p = 0.2544.
TEST(RankTest, IsThatOfAPublishedExample) {
  const RankTest test =
      rank_test({0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46}, {1.15, 0.88, 0.90, 0.74, 1.21});
  EXPECT_EQ(test.u, 35);
  EXPECT_DOUBLE_EQ(test.superiority, 0.7);
  EXPECT_NEAR(test.p, 0.2544, 5e-5);
  EXPECT_TRUE(test.exact);
}

/// p of all ways to choose the first group, one by one.
double counted_p(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> all = a;
  all.insert(all.end(), b.begin(), b.end());
  const auto u_of = [&](const std::vector<bool>& chosen) {
    double u = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = 0; j < all.size(); ++j)
        if (chosen[i] && !chosen[j]) u += all[i] > all[j] ? 1 : all[i] == all[j] ? 0.5 : 0;
    return u;
  };
  std::vector<bool> chosen(all.size());
  std::fill(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(a.size()), true);
  const double mean = static_cast<double>(a.size() * b.size()) / 2, off = std::fabs(u_of(chosen) - mean);
  double far = 0, ways = 0;
  std::sort(chosen.begin(), chosen.end());
  do {
    ways += 1, far += std::fabs(u_of(chosen) - mean) >= off - 1e-9;
  } while (std::next_permutation(chosen.begin(), chosen.end()));
  return far / ways;
}

TEST(RankTest, IsExactWithTies) {
  std::mt19937 random(5);
  for (int round = 0; round < 60; ++round) {
    std::vector<double> a(2 + random() % 5), b(2 + random() % 5);
    for (double& x : a) x = static_cast<double>(random() % 4);
    for (double& x : b) x = static_cast<double>(random() % 5);
    EXPECT_NEAR(rank_test(a, b).p, counted_p(a, b), 1e-12);
    EXPECT_NEAR(rank_test(a, b).p, rank_test(b, a).p, 1e-12);
    EXPECT_NEAR(rank_test(a, b).superiority + rank_test(b, a).superiority, 1, 1e-12);
  }
  EXPECT_EQ(rank_test({1, 1}, {1, 1, 1}).p, 1);
}

/// Beyond what is exact, the normal distribution goes on where the exact one ends.
TEST(RankTest, LargeGroupsGoOnWhereSmallOnesEnd) {
  std::vector<double> a, b;
  for (int i = 0; i < 40; ++i) a.push_back(i), b.push_back(i + 7.5);
  const RankTest exact = rank_test(a, b);
  b.push_back(27);
  const RankTest normal = rank_test(a, b);
  EXPECT_TRUE(exact.exact);
  EXPECT_FALSE(normal.exact);
  EXPECT_NEAR(std::log(normal.p), std::log(exact.p), 0.15);
}

/// Holm (1979): 0.01, 0.02, 0.03 of four.
TEST(RankTest, HolmsCorrectionNeverFalls) {
  const std::vector<double> p = holm({0.03, 0.01, 0.6, 0.02});
  EXPECT_NEAR(p[1], 0.04, 1e-12);
  EXPECT_NEAR(p[3], 0.06, 1e-12);
  EXPECT_NEAR(p[0], 0.06, 1e-12);
  EXPECT_NEAR(p[2], 0.6, 1e-12);
}

/// Shrout and Fleiss (1979), tables 2 and 4: six targets, four judges; ICC(2,1) 0.29, ICC(3,1) 0.71. The interval is
/// that of McGraw and Wong (1996) for the same table, 0.019 to 0.76.
TEST(Agreement, IsThatOfThePublishedExample) {
  const Agreement found =
      agreement({{9, 2, 5, 8}, {6, 1, 3, 2}, {8, 4, 6, 8}, {7, 1, 2, 6}, {10, 5, 6, 9}, {6, 2, 4, 7}});
  EXPECT_NEAR(found.icc, 0.29, 0.005);
  EXPECT_NEAR(found.consistency, 0.71, 0.006);
  EXPECT_NEAR(found.low, 0.019, 0.001);
  EXPECT_NEAR(found.high, 0.76, 0.005);
  EXPECT_EQ(found.participants, 6u);
  EXPECT_EQ(found.trials, 4u);
}

TEST(Agreement, OfWhatIsRepeatedExactlyIsOne) {
  EXPECT_NEAR(agreement({{1, 1}, {2, 2}, {5, 5}}).icc, 1, 1e-12);
  EXPECT_TRUE(std::isnan(agreement({{3, 3}, {3, 3}}).icc));
  EXPECT_TRUE(std::isnan(agreement({{0.1, 0.3, 0.7}, {0.1, 0.3, 0.7}}).icc)) << "rounding is no difference";
}

/// Small whole numbers, as errors are counted: no degree of freedom is left, or no bound.
TEST(Agreement, WithoutAnIntervalItHasNone) {
  for (const std::vector<std::vector<double>>& trials : std::vector<std::vector<std::vector<double>>>{
           {{0, 2, 2}, {0, 2, 2}, {2, 2, 0}}, {{37, 32, 25}, {37, 25, 32}, {25, 32, 37}}, {{1, 2}, {2, 1}, {1, 2}}}) {
    const Agreement found = agreement(trials);
    EXPECT_EQ(std::isnan(found.low), std::isnan(found.high));
    EXPECT_TRUE(std::isnan(found.low) || (found.low <= found.icc && found.icc <= found.high));
  }
}

class StudyTables : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  /// What is said of these tables; "" if nothing is.
  std::string refusal(const std::string& people, const std::string& runs, const std::string& answers = "") const {
    try {
      read_study(put("p.csv", people), {put("r.csv", runs)},
                 answers.empty() ? std::vector<std::string>{} : std::vector{put("a.csv", answers)});
      return "";
    } catch (const LoadError& error) {
      return error.what();
    }
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("ostium-study-" + std::to_string(getpid()));
  const std::string people_ = "code,group,procedures\nP01,novice,0\nP02,novice,3\nP03,expert,400\nP04,expert,900\n";
  const std::string runs_ =
      "code,case,script,seed,outcome,reason,simulated_s,procedure_time_s,handling_errors,item_heparin\n"
      "P01,rca,s,0,failure,,1,600,9,1\nP01-2,rca,s,0,success,,1,500,7,1\nP02-1,rca,s,0,success,,1,650,9,0\n"
      "P02-2,rca,s,0,success,,1,480,6,1\nP03,rca,s,0,success,,1,300,2,1\nP03-2,rca,s,0,success,,1,280,1,1\n"
      "P04,rca,s,0,success,,1,320,,1\nP04-2,rca,s,0,success,,1,290,0,1\n";
};

TEST_F(StudyTables, AParticipantCountsOnceWithTheMedianOfTheTrials) {
  const std::string answers =
      "code,part,statement,answer,remark\nP01,face,It looks right.,4,\"=1+1, odd\"\nP03,face,It looks right.,2,\n"
      "P01,about,Years,3,\nP03,about,Years,12,\nP04,face,It looks right.,,only a remark\n";
  const Study study = read_study(put("p.csv", people_), {put("r.csv", runs_)}, {put("a.csv", answers)});
  ASSERT_EQ(study.metrics, (std::vector<std::string>{"procedure_time_s", "handling_errors"}));
  const std::vector<ComparedCase> compared = compare(study);
  ASSERT_EQ(compared.size(), 1u);
  EXPECT_EQ(compared[0].trials, 2);
  const ComparedMetric& time = compared[0].metrics[0];
  EXPECT_EQ(time.groups[0].values, (std::vector<double>{550, 565}));
  EXPECT_EQ(time.groups[1].values, (std::vector<double>{290, 305}));
  EXPECT_EQ(time.pairs[0].test.u, 4);
  EXPECT_NEAR(time.pairs[0].test.p, 2.0 / 6, 1e-12);  // of six ways to choose two of four, two lie as far out
  EXPECT_EQ(time.by_trial[0], (std::vector<double>{625, 490}));
  EXPECT_EQ(time.agreement->participants, 4u);
  EXPECT_EQ(compared[0].metrics[1].agreement->participants, 3u) << "one has no number in the first trial";
  const std::vector<AnsweredStatement> statements = statements_of(study);
  ASSERT_EQ(statements.size(), 1u);
  EXPECT_EQ(statements[0].counts[0], (std::vector<int>{0, 0, 0, 1, 0}));
  EXPECT_EQ(statements[0].median, 3);
  const std::string page = study_page(study, compared);
  for (const char* words :
       {"Years", "3 [3 to 3]", "557.5", "only a remark", "no p below 0.33", "not yet what makes a score valid"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
  const auto json = nlohmann::json::parse(study_json(study, compared));
  EXPECT_EQ(json["cases"][0]["metrics"][0]["groups"][1]["median"], 297.5);
  const std::string csv = study_csv(study, compared);
  EXPECT_NE(csv.find("rca,procedure_time_s,2,557.5,"), std::string::npos) << csv;
}

TEST_F(StudyTables, WhatIsWrongIsNamedWithItsLine) {
  EXPECT_EQ(refusal(people_, runs_), "");
  const auto says = [&](const std::string& found, const std::string& wanted) {
    EXPECT_NE(found.find(wanted), std::string::npos) << found;
  };
  says(refusal("code,group\nP01,a\nP01,b\n", runs_), "p.csv:3: there is another participant P01");
  says(refusal("code,group\nP01,Novice\nP02,novice\n", runs_), "p.csv:3: there are groups \"Novice\" and \"novice\"");
  says(refusal("code,group\nP01,\n", runs_), "p.csv:2: a participant without a code or a group");
  says(refusal("code\nP01\n", runs_), "p.csv:1: there is no column \"group\"");
  says(refusal(people_, "code,case,outcome,x\nP09,c,success,1\n"), "r.csv:2: \"P09\" is no participant's code");
  says(refusal(people_, "code,case,outcome,x\nP01-0,c,success,1\n"), "r.csv:2: \"P01-0\" is no participant's code");
  says(refusal(people_, "code,case,outcome,x\nP01,c,success,1\nP01-1,c,success,1\n"), "r.csv:3: trial 1 of P01 in c");
  says(refusal(people_, "code,case,outcome,x\nP01,c,success,fast\n"), "r.csv:2");
  says(refusal(people_, "code,case,outcome,x,x\nP01,c,success,1,2\n"), "r.csv:1: there are several columns \"x\"");
  says(refusal(people_, runs_, "code,part,statement,answer,remark\nP01,face,s,6,\n"), "a.csv:2: the answer is \"6\"");
  says(refusal(people_, runs_, "code,part,statement,answer,remark\nP01,face,s,1,\nP01,face,s,2,\n"),
       "a.csv:3: P01 has answered \"s\" already");
  says(refusal(people_, runs_, "code,part,statement,answer,remark\nP01,about,procedures,5,\n"), "was \"0\" before");
}

/// What the page's script writes is what is read here.
TEST_F(StudyTables, TheQuestionnaireSavesTheColumnsThatAreRead) {
  const std::string page = questionnaire_page();
  EXPECT_NE(page.find("['code', 'part', 'statement', 'answer', 'remark']"), std::string::npos);
  for (const char* part : {"about", "face", "content"})
    EXPECT_NE(page.find("data-part=\"" + std::string(part) + "\""), std::string::npos);
}

}  // namespace
}  // namespace ostium::data
