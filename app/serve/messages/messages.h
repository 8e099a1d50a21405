#pragma once
/// What the trainer's station tells its page: JSON texts, and bytes that begin with their kind (app/serve/README.md).
#include <map>
#include <optional>

#include "app/serve/http/server.h"
#include "app/session/live/live_picture.h"
#include "data/assessment/score_list.h"

namespace ostium::app {

/// A moment of the timeline.
struct TimelineEntry {
  int number = 0;  ///< from 1, without gaps
  double second = 0;
  std::string kind;  ///< "step", "event", "error", "critical", "mark"
  std::string words;
};
std::string message_of(const std::vector<TimelineEntry>& moments);

/// What a beginner is told beside the run; no title: it is no lesson.
struct LessonWords {
  struct Instruction {
    std::string text;
    bool ticks = false;              ///< whether anything ticks it
    std::vector<std::string> hints;  ///< how the expert does it, step by step
  };
  std::string title, goal;
  std::vector<Instruction> instructions;
  std::vector<std::size_t> needed;  ///< items of the scoring list that must hold to go on; none: it is only shown
  std::string next;                 ///< title of the lesson after it; empty: the last
  bool exam = false;                ///< nothing is told that helps or judges: hints, errors, scores, the hidden truth
};

/// What does not change during a run.
struct Setting {
  Setting(const SessionModel& model, const ScriptPlan& plan, data::ScoreList scoring);
  const SessionModel& model;
  const ScriptPlan& plan;
  data::ScoreList scoring;
  std::vector<std::string> signals;
  std::vector<int> spheres;  ///< of the vessel's tree, those that are drawn
  std::string title;         ///< of case and script
  LessonWords lesson;
};
/// `viewer_link`: for the trainer to pass on; empty for viewers. `goes_back`: whether the run can.
std::string welcome(const Setting& setting, Role role, const std::string& viewer_link, bool goes_back);

/// Numbers and traces of a moment.
std::string message_of(const Setting& setting, const Snapshot& now, const LivePicture& live);
std::string scores_message(const data::ScoreList& list, const std::vector<data::Score>& scores);
/// When each of the lesson's instructions was ticked.
std::string ticks_message(const std::vector<std::optional<double>>& at_s);
std::string refusal(const std::string& what, const std::string& why);

/// Kind 1 (live) or 2 (reference), then at byte 8 the second, at 16 a JPEG.
std::string picture_bytes(int kind, double second, const fluoro::Picture& picture);
/// Kind 3, then at byte 8 the second; then 32-bit numbers: how many tools; of each how many nodes, of each node x, y, z
/// in mm and the wall's force in N; how many spheres of the tree, of each x, y, z in mm.
std::string truth_bytes(const Setting& setting, const Snapshot& now);

}  // namespace ostium::app
