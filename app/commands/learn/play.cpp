#include <fmt/format.h>

#include "app/command_line/command.h"
#include "app/commands/learn/attend.h"

namespace ostium::app {

namespace {

struct Arguments {
  std::optional<int> person;
  std::vector<std::string> set;
  Attendance attendance = {.lesson = "", .folder = "ostium-play"};
};

void declare(Options& options, Arguments& a) {
  declare_attendance(options, "--case", a.attendance);
  options.add("--person", a.person, "Another patient with each case: 0, 1, 2, ...").range(0, 1'000'000);
  options.add("--set", a.set, "Another instrument for a tool, or heart_rate, breathing, arteries, as in `ostium run`")
      .type("KEY=VALUE");
}

int run(const Arguments& a) {
  Attendance attendance = a.attendance;
  if (a.person && !attendance.lesson.empty()) attendance.lesson += fmt::format("-person-{}", *a.person);
  const auto person = a.person ? std::optional(static_cast<std::uint64_t>(*a.person)) : std::nullopt;
  return attend_course(data::procedures_course(person, a.set), attendance,
                       [&](std::optional<std::uint64_t> other) { return data::procedures_course(other, a.set); });
}

}  // namespace

Command play_command() {
  return make_command("play",
                      "Every case by hand, in the browser: steps that tick themselves, hints, the expert to watch",
                      {"ostium play", "ostium play --list", "ostium play --case rca-mid-focal --person 3",
                       "ostium play --case lad-diagonal --show"},
                      declare, run);
}

}  // namespace ostium::app
