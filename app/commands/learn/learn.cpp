#include "app/command_line/command.h"
#include "app/commands/learn/attend.h"

namespace ostium::app {

namespace {

struct Arguments {
  std::string course = "first-steps";
  Attendance attendance = {.lesson = "", .folder = "ostium-learn"};
};

void declare(Options& options, Arguments& a) {
  options.add("course", a.course, "One of data/courses, or a file").type("NAME|FILE.json").show_default();
  declare_attendance(options, "--lesson", a.attendance);
}

int run(const Arguments& a) { return attend_course(data::find_course(a.course), a.attendance); }

}  // namespace

Command learn_command() {
  return make_command("learn", "A course of lessons in the browser",
                      {"ostium learn", "ostium learn --show", "ostium learn --list",
                       "ostium learn my-course.json --lesson over-the-arch"},
                      declare, run);
}

}  // namespace ostium::app
