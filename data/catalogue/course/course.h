#pragma once
/// A course: lessons in their order, and what must hold to go on (data/courses/NAME.json, schemas/course.schema.json).
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "data/catalogue/script/script.h"

namespace ostium::data {

struct Instruction {
  std::string text;
  std::vector<ScriptCondition> until;      ///< it has been done once one of them holds, or once `event` comes
  std::vector<ScriptCondition> meanwhile;  ///< all of them hold, or what `until` counts begins anew
  std::string event;                       ///< of data/assessment/events.def; empty: none
  bool in_turn = false;                    ///< only after the one before it with a condition
  int expert_step = -1;                    ///< of the lesson's script: how the expert does it; -1: it is not said
  int line = 0;
  bool ticks() const { return !until.empty() || !event.empty(); }
};

struct Lesson {
  std::string name, title, goal;
  std::vector<Instruction> instructions;
  std::string case_name, script, scoring;
  std::optional<std::uint64_t> person;
  std::string begin;                   ///< "LM" or "RCA": the guide's tip lies before it; empty: nothing is in yet
  std::vector<std::string> set;        ///< "KEY=VALUE", as `ostium run --set` takes them
  std::vector<std::string> must_hold;  ///< ids of the scoring list's items
  double limit_s = 0;                  ///< it ends by itself then; 0: never
  bool exam = false;                   ///< no hints, no expert, and nothing is told of errors and scores
  int line = 0;                        ///< where `must_hold` stands
};

struct Course {
  std::string name, title, note, file;
  bool in_order = true;  ///< a lesson opens once the one before it has been passed
  std::vector<Lesson> lessons;
};

/// Throws LoadError with file, line, key and what was expected; also for a case or script that there is not.
Course read_course(const std::string& file, const std::string& text);
/// data/courses/NAME.json, or a file.
Course find_course(const std::string& name_or_file);
/// Every case with the procedure that ships for it, in any order: the steps are those of the procedure's script. `set`:
/// of every lesson.
Course procedures_course(std::optional<std::uint64_t> person = {}, const std::vector<std::string>& set = {});
/// Names in data/courses, sorted.
std::vector<std::string> course_names();

}  // namespace ostium::data
