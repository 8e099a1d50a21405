/// Courses: those that ship can be read, and a faulty one says where and what it should be.
#include "data/catalogue/course/course.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <string>

#include "data/assessment/score_list.h"
#include "data/catalogue/case/case.h"
#include "data/catalogue/catalogue.h"
#include "data/formats/load_error.h"

namespace ostium::data {
namespace {

const std::string good = R"({
  "schema": "ostium-course/1", "name": "mine", "title": "Mine", "note": "a draft",
  "lessons": [
    { "name": "one", "title": "One", "goal": "done", "instructions": ["push"],
      "case": "rca-mid-focal", "script": "iliac-wire", "scoring": "lesson-feed-and-turn",
      "must_hold": ["1"] } ] })";

void expect_judged(const Course& course) {
  for (const Lesson& lesson : course.lessons) {
    const ScoreList list = find_score_list(lesson.scoring);
    for (const std::string& id : lesson.must_hold)
      EXPECT_TRUE(std::any_of(list.items.begin(), list.items.end(),
                              [&](const ScoreItem& item) { return item.id == id && item.check; }))
          << lesson.name << ", " << id;
  }
}

TEST(Course, ThoseThatShipHaveWhatTheyName) {
  ASSERT_FALSE(course_names().empty());
  for (const std::string& name : course_names()) {
    const Course course = find_course(name);
    EXPECT_EQ(course.name, name);
    EXPECT_TRUE(course.in_order);
    expect_judged(course);
  }
}

/// Steps tick one after another, in the expert's order, from heparin to the last instrument that is drawn out.
TEST(Course, EveryCaseIsALessonOfItsProcedure) {
  const Course course = procedures_course(3, {"heart_rate=80"});
  EXPECT_FALSE(course.in_order);
  expect_judged(course);
  std::size_t ships = 0;
  for (const Case& c : load_cases()) ships += !c.imported;
  EXPECT_EQ(course.lessons.size(), ships);
  for (const Lesson& lesson : course.lessons) {
    EXPECT_EQ(lesson.name, lesson.case_name + "-person-3");
    EXPECT_EQ(lesson.set, std::vector<std::string>{"heart_rate=80"});
    EXPECT_EQ(lesson.person, 3u);
    EXPECT_GE(lesson.instructions.size(), 12u) << lesson.name;
    EXPECT_LE(lesson.instructions.size(), 60u) << lesson.name;
    int before = -1;
    std::string texts;
    for (const Instruction& one : lesson.instructions) {
      EXPECT_TRUE(one.ticks()) << one.text;
      EXPECT_GT(one.expert_step, before) << one.text;
      before = one.expert_step, texts += one.text + "\n";
    }
    for (const char* step : {"Give heparin.", "Draw the J wire out.", "atm: stent opened"})
      EXPECT_NE(texts.find(step), std::string::npos) << lesson.name << ":\n" << texts;
  }
}

TEST(Course, LessonsMayBeOpenInAnyOrderAndSetWhatRunsSet) {
  std::string text = good;
  text.replace(text.find("\"lessons\""), 9, "\"any_order\": true, \"lessons\"");
  text.replace(text.find("\"must_hold\""), 11, "\"set\": [\"heart_rate=90\"], \"must_hold\"");
  const Course course = read_course("mine.json", text);
  EXPECT_FALSE(course.in_order);
  EXPECT_EQ(course.lessons[0].set, std::vector<std::string>{"heart_rate=90"});
}

/// Practice with a limit, then trials of which nothing is told, from the template of a study.
TEST(Course, AStudysTrialsAreExamsThatEndByThemselves) {
  const Course course = find_course(data_folder() + "/study/template/trials.json");
  EXPECT_TRUE(course.in_order);
  ASSERT_EQ(course.lessons.size(), 4U);
  EXPECT_DOUBLE_EQ(course.lessons[0].limit_s, 600);
  EXPECT_FALSE(course.lessons[0].exam);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_TRUE(course.lessons[i].exam);
    EXPECT_DOUBLE_EQ(course.lessons[i].limit_s, 1200);
    EXPECT_TRUE(course.lessons[i].must_hold.empty());
    EXPECT_EQ(course.lessons[i].case_name, course.lessons[1].case_name) << "the same for all";
  }
}

/// Each lesson's case and script were read anew: 3,000 lessons took a minute.
TEST(Course, OfThousandsOfLessonsIsReadInASecond) {
  const auto lesson = good.find("{ \"name\": \"one\"");
  std::string many = good.substr(0, lesson);
  const std::string one = good.substr(lesson, good.rfind(']') - lesson);
  for (int i = 0; i < 3000; ++i) {
    std::string own = one;
    own.replace(own.find("\"one\""), 5, "\"l" + std::to_string(i) + "\"");
    many += (i ? "," : "") + own;
  }
  const std::clock_t before = std::clock();
  EXPECT_EQ(read_course("mine.json", many + "] }").lessons.size(), 3000u);
  EXPECT_LT(static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC, 10) << "of this process' time";
}

TEST(Course, AFaultyOneNamesFileLineKeyAndCure) {
  EXPECT_EQ(read_course("mine.json", good).lessons[0].must_hold, std::vector<std::string>{"1"});
  struct Fault {
    std::string from, to, says;
  };
  const Fault faults[] = {
      {"\"goal\": \"done\", ", "", "mine.json:4: lessons[0].goal is missing"},
      {"[\"push\"]", "[]", "mine.json:4: lessons[0].instructions"},
      {"[\"push\"]", "[7]", "mine.json:4: lessons[0].instructions[0] is 7; expected a text"},
      {"\"push\"", R"({ "text": "push" })",
       "mine.json:4: lessons[0].instructions[0] says nothing that ticks it; expected until, event or label"},
      {"\"push\"", R"({ "text": "push", "until": [{ "fed": 7 }] })", "mine.json:4: lessons[0].instructions[0].until"},
      {"\"push\"", R"({ "text": "push", "until": [{ "out": true, "of": "balloon" }] })",
       "expected one of the script's tools: wire"},
      {"\"push\"", R"({ "text": "push", "label": "nowhere" })",
       "mine.json:4: lessons[0].instructions[0].label is \"nowhere\"; expected a label of the lesson's script: "},
      {"\"push\"", R"({ "text": "push", "event": "tool_in", "in_turn": true })",
       "lessons[0].instructions[0].in_turn is true; expected false"},
      {"\"push\"", R"({ "text": "push", "when": "now" })", "when"},
      {"\"push\"", R"({ "text": "push", "event": "tool_in", "while": [{ "out": true }] })",
       "mine.json:4: lessons[0].instructions[0].while is [{...}]; expected until beside it"},
      {"rca-mid-focal", "rca-nowhere", "mine.json:5: lessons[0].case is \"rca-nowhere\": there is no case"},
      {"iliac-wire", "no-script", "mine.json:5: lessons[0].script is \"no-script\": there is no script"},
      {"\"name\": \"one\"", "\"name\": \"../one\"", "mine.json:4: lessons[0].name"},
      {"\"must_hold\"", "\"must_be\"", "must_be"},
      {"[\"1\"]", "[\"1\", \"1\"]", "mine.json:6: lessons[0].must_hold[1] is \"1\"; expected each id once"},
      {"\"Mine\"", R"("Mi\u001b[2Jne")", "mine.json:2: title \"Mi?[2Jne\" holds a control character"},
      {"\"Mine\"", R"("Mi\u009b2Jne")", "mine.json:2: title \"Mi?2Jne\" holds a control character"},
      {"\"name\": \"mine\"", "\"name\": \"other\"", "the file's name without .json"},
      {"ostium-course/1", "ostium-course/9", "ostium-course/1"}};
  for (const Fault& fault : faults) {
    std::string text = good;
    text.replace(text.find(fault.from), fault.from.size(), fault.to);
    try {
      read_course("mine.json", text);
      ADD_FAILURE() << fault.to;
    } catch (const LoadError& error) {
      EXPECT_NE(std::string(error.what()).find(fault.says), std::string::npos) << fault.says << "\n" << error.what();
    }
  }
  try {
    find_course("nothing");
    ADD_FAILURE();
  } catch (const LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("first-steps"), std::string::npos) << error.what();
  }
}

TEST(Course, AnInstructionIsTickedByConditionsAnEventOrTheExpertsStep) {
  std::string text = good;
  text.replace(text.find("\"push\""), 6, R"("look", { "text": "in", "until": [{ "inserted_mm": 50 }] },
    { "text": "seen", "event": "fluoroscopy_on" }, { "text": "up", "label": "up" },
    { "text": "out", "label": "out", "until": [{ "out": true }], "while": [{ "trace": "absent" }], "in_turn": true })");
  text.replace(text.find("iliac-wire"), 10, "wire-in-and-out");
  const std::vector<Instruction> all = read_course("mine.json", text).lessons[0].instructions;
  ASSERT_EQ(all.size(), 5u);
  EXPECT_FALSE(all[0].ticks());
  EXPECT_EQ(all[1].until.at(0).kind, ConditionKind::inserted);
  EXPECT_EQ(all[1].until.at(0).value, 0.05);
  EXPECT_EQ(all[2].event, "fluoroscopy_on");
  EXPECT_EQ(all[3].until.at(0).value, 0.25) << "what the expert's step waits for";
  EXPECT_EQ(all[3].expert_step, 2);
  EXPECT_TRUE(all[4].in_turn);
  EXPECT_EQ(all[4].until.size(), 1u);
  EXPECT_EQ(all[4].meanwhile.at(0).kind, ConditionKind::trace);
}

/// Not only when the lesson begins.
TEST(Course, ALessonWhoseScriptComesInElsewhereThanItsCaseIsRefused) {
  const auto with = [](const std::string& of_case, const std::string& script) {
    std::string text = good;
    text.replace(text.find("rca-mid-focal"), 13, of_case);
    text.replace(text.find("iliac-wire"), 10, script);
    return read_course("mine.json", text);
  };
  EXPECT_NO_THROW(with("rca-mid-focal-radial", "pci-rca-mid-focal-radial"));
  EXPECT_NO_THROW(with("rca-mid-focal-radial", "fibrillation-shocked")) << "in any case";
  try {
    with("rca-mid-focal-radial", "pci-rca-mid-focal");
    ADD_FAILURE();
  } catch (const LoadError& error) {
    for (const char* word : {"mine.json:5: lessons[0].script is \"pci-rca-mid-focal\"", "for femoral access",
                             "rca-mid-focal-radial has radial access"})
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace ostium::data
