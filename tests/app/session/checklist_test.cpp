/// The instructions of lessons tick as the expert of the lesson does what they say, and go back with the run.
#include "app/session/live/checklist.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "app/session/live/live_driver.h"
#include "app/session/recorder/event_watch.h"
#include "data/formats/load_error.h"
#include "tests/app/session/tube_vessel.h"

namespace ostium::app {
namespace {

struct Lesson {
  RunSetup setup;
  std::shared_ptr<const Vessel> vessel;
};

Lesson patient_of(const data::Lesson& lesson) {
  Lesson out;
  set_vessel(lesson.case_name, vascular::LengthUnit::millimetre, out.setup);
  set_script(data::find_script(lesson.script), out.setup);
  if (lesson.person) set_value("person", std::to_string(*lesson.person), out.setup);
  if (!lesson.begin.empty()) set_value("begin", lesson.begin, out.setup);
  std::string warnings;
  out.vessel = make_vessel(out.setup, warnings);
  choose_sizes(*out.vessel, out.setup);
  return out;
}

/// The expert's run with its checklist; events of the recording.
std::vector<SessionEvent> played(ScriptedRun& run, Checklist& checklist) {
  LiveDriver hand(run.model, Hands::script, 1);
  hand.follow(&checklist);
  run.take_over(&hand);
  EventWatch watch(run.model);
  std::vector<SessionEvent> all, fresh;
  while (run.tick()) {
    watch.look(run.model, run.inputs, run.state, run.report, run.events, fresh);
    for (const SessionEvent& event : fresh) checklist.hear(event);
    all.insert(all.end(), fresh.begin(), fresh.end());
    fresh.clear();
  }
  checklist.look(run);  // a script may end within its last step
  std::vector<OperatorEvent> done;
  checklist.take_done(done);
  for (const OperatorEvent& one : done)
    all.push_back(
        {run.state.rods.step, static_cast<int>(data::EventCode::instruction_done), -1, static_cast<double>(one.step)});
  return all;
}

std::vector<double> ticked(const std::vector<SessionEvent>& events) {
  std::vector<double> out;
  for (const SessionEvent& e : events)
    if (e.code == static_cast<int>(data::EventCode::instruction_done)) out.push_back(e.value);
  return out;
}

/// Minutes for the whole course; OSTIUM_LESSONS=all asks for it, OSTIUM_LESSONS=NAME for one lesson.
TEST(Checklist, TheExpertOfALessonTicksItsInstructions) {
  const data::Course course = data::find_course("first-steps");
  const char* asked = std::getenv("OSTIUM_LESSONS");
  const std::string which = asked ? asked : "feed-and-turn";
  for (const data::Lesson& lesson : course.lessons) {
    if (which != "all" && lesson.name != which) continue;
    const Lesson patient = patient_of(lesson);
    ScriptedRun run(patient.setup, patient.vessel);
    Checklist checklist(lesson.instructions, patient.setup.script, run.model);
    const std::vector<double> done = ticked(played(run, checklist));
    for (std::size_t i = 0; i < lesson.instructions.size(); ++i)
      EXPECT_EQ(std::count(done.begin(), done.end(), static_cast<double>(i)), lesson.instructions[i].ticks() ? 1 : 0)
          << lesson.name << ": " << lesson.instructions[i].text;
  }
}

const char* const in_and_out = R"({
  "schema": "ostium-script/1", "name": "in-and-out", "title": "A test",
  "tools": [ { "name": "wire", "instrument": "cook-j" } ],
  "steps": [
    { "do": "fluoroscopy", "on": true },
    { "do": "advance", "tool": "wire", "speed_mm_s": 100, "until": [{ "inserted_mm": 60 }] },
    { "do": "withdraw", "tool": "wire", "speed_mm_s": 100, "until": [{ "out": true }] },
    { "do": "wait", "until": [{ "seconds": 0.3 }] } ]
})";

data::Instruction until(const data::ScriptCondition& condition, bool in_turn) {
  data::Instruction out;
  out.until = {condition}, out.in_turn = in_turn;
  return out;
}

std::vector<data::Instruction> four_instructions() {
  const data::Script script = data::read_script("in-and-out.json", in_and_out);
  data::Instruction beam, off;
  beam.event = "fluoroscopy_on", off.event = "cine_on";
  return {until(script.steps[1].until[0], false), until(script.steps[2].until[0], true), beam, off};
}

TEST(Checklist, InTurnMeansAfterTheOneBefore) {
  const RunSetup setup = tube_setup(in_and_out);
  ScriptedRun run(setup, tube_vessel());
  Checklist checklist(four_instructions(), setup.script, run.model);
  const std::vector<SessionEvent> events = played(run, checklist);
  EXPECT_EQ(ticked(events), (std::vector<double>{2, 0, 1}))
      << "the wire is out at first, but that is not its turn; nobody filmed";

  // As the run goes back to before the second, what came after is to be done again.
  std::vector<SessionEvent> before;
  for (const SessionEvent& e : events)
    if (e.step < 800) before.push_back(e);
  checklist.go_back(before);
  std::vector<OperatorEvent> done;
  checklist.look(run);
  checklist.take_done(done);
  ASSERT_EQ(done.size(), 1u);
  EXPECT_EQ(done[0].step, 1) << "the wire is out now";
}

/// "For so long, while the curve is right": a guide that sits well for a moment, and then not, has not sat well.
TEST(Checklist, WhatIsCountedBeginsAnewWhereItDoesNotHold) {
  const RunSetup setup = tube_setup(in_and_out);
  ScriptedRun run(setup, tube_vessel());
  data::Instruction for_0_2_s, longer;
  for_0_2_s.until = {setup.script.steps[3].until[0]};
  for_0_2_s.until[0].value = 0.2;
  for_0_2_s.meanwhile = {setup.script.steps[2].until[0]};  // out
  longer = for_0_2_s;
  longer.until[0].value = 0.5;
  Checklist checklist({for_0_2_s, longer}, setup.script, run.model);
  const std::vector<SessionEvent> events = played(run, checklist);
  ASSERT_EQ(ticked(events), std::vector<double>{0}) << "it was never out for half a second";
  const auto out = std::find_if(events.rbegin(), events.rend(), [](const SessionEvent& e) {
    return e.code == static_cast<int>(data::EventCode::tool_out);
  });
  const auto done = std::find_if(events.begin(), events.end(), [](const SessionEvent& e) {
    return e.code == static_cast<int>(data::EventCode::instruction_done);
  });
  ASSERT_NE(out, events.rend());
  EXPECT_GE(done->step, out->step + 150) << "not from the beginning, when it was out for a moment";
}

TEST(Checklist, APlaceThatThereIsNotIsRefusedWithTheCoursesLine) {
  const RunSetup setup = tube_setup(in_and_out);
  const ScriptedRun run(setup, tube_vessel());
  data::ScriptCondition nowhere;
  nowhere.kind = data::ConditionKind::tip_passes, nowhere.place = "moon", nowhere.file = "mine.json", nowhere.line = 7;
  try {
    Checklist({until(nowhere, false)}, setup.script, run.model);
    ADD_FAILURE();
  } catch (const data::LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("mine.json:7: there is no place \"moon\""), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace ostium::app
