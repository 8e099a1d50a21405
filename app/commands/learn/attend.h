#pragma once
/// A course as a command opens it: checked, listed or attended.
#include "app/command_line/options.h"
#include "app/commands/learn/schooling.h"

namespace ostium::app {

struct Attendance {
  std::string lesson;  ///< empty: the page lists them
  std::string folder;
  int port = 0;
  bool list = false, show = false;
};
/// --lesson (called `lesson` there), --out, --port, --show and --list.
void declare_attendance(Options& options, const std::string& lesson, Attendance& a);

/// Until the learner closes it. Exit code. Throws LoadError for a course that cannot be judged as it says.
int attend_course(const data::Course& course, const Attendance& a, const Schooling::ForPerson& for_person = {});

}  // namespace ostium::app
