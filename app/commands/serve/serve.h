#pragma once
/// A run with a trainer's station that can go back; `learn` sits learners down at the same.
#include <functional>

#include "app/commands/run/session_arguments.h"
#include "app/serve/classroom/classroom.h"
#include "data/catalogue/course/course.h"

namespace ostium::app {

struct ServeArguments {
  SessionArguments session;           ///< without a script: the angioplasty that is written for the case
  std::string folder;                 ///< empty: one that is removed at the end
  std::string address = "127.0.0.1";  ///< where it listens
  int port = 0;
  std::string hands = "script";  ///< or browser
  std::string scoring = "pci-elective";
  bool at_once = false;  ///< does not wait for the trainer's "go on"
  bool report = true;
  LessonWords lesson;                                ///< empty: none
  std::vector<data::Instruction> instructions = {};  ///< the lesson's, which are ticked
  Classroom* classroom = nullptr;                    ///< it sits in there; null: it has a server and links of its own
  std::optional<Continued> resumes = {};             ///< a recording in the folder, which goes on from there
  /// Called each time a run or a branch has come to its end, before anybody leaves; may be empty.
  std::function<void(const struct Served&)> ended;
};

struct Served {
  PlayReport report;                ///< of the last branch
  std::vector<data::Score> scores;  ///< of it; empty: it did not come to its end
  std::string problem = {};         ///< why not all of it could be kept; empty: all was
};

/// Prints the links, unless in a classroom; returns when the trainer leaves. Throws LoadError or MeshError.
Served serve(const ServeArguments& arguments);

}  // namespace ostium::app
