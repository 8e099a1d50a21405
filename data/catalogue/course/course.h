#pragma once
/// A course: lessons in their order, and what must hold to go on (data/courses/NAME.json, schemas/course.schema.json).
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostium::data {

struct Lesson {
  std::string name, title, goal;
  std::vector<std::string> instructions;
  std::string case_name, script, scoring;
  std::optional<std::uint64_t> person;
  std::string begin;                   ///< "LM" or "RCA": the guide's tip lies before it; empty: nothing is in yet
  std::vector<std::string> must_hold;  ///< ids of the scoring list's items
  int line = 0;                        ///< where `must_hold` stands
};

struct Course {
  std::string name, title, note, file;
  std::vector<Lesson> lessons;
};

/// Throws LoadError with file, line, key and what was expected; also for a case or script that there is not.
Course read_course(const std::string& file, const std::string& text);
/// data/courses/NAME.json, or a file.
Course find_course(const std::string& name_or_file);
/// Names in data/courses, sorted.
std::vector<std::string> course_names();

}  // namespace ostium::data
