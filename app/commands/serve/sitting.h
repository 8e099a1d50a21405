#pragma once
/// A run with a station and its branches, one after another, in a folder.
#include "app/commands/serve/serve.h"
#include "app/session/live/checklist.h"

namespace ostium::app {

class Sitting {
 public:
  /// All must outlive it. Where an earlier recording goes on, the run stands there afterwards, paused. Throws LoadError
  /// if it cannot go on.
  Sitting(const ServeArguments& a, const RunSetup& setup, ScriptedRun& run, LiveDriver& hand, Station& station,
          Checklist& checklist, const data::ScoreList& list);

  /// Until the trainer leaves, or the program is asked to end.
  Served play_all();

 private:
  Wish play_once(const std::function<void()>& begun);
  Wish go_on_from(std::size_t second);
  void stand_at(const Continued& from);
  void finish(const std::string& file);
  void note_problem(const std::string& what);
  void keep(const std::function<void()>& what);
  std::vector<SessionEvent> events_before(const Continued& from) const;

  const ServeArguments& a_;
  const RunSetup& setup_;
  ScriptedRun& run_;
  LiveDriver& hand_;
  Station& station_;
  Checklist& checklist_;
  const data::ScoreList& list_;
  std::shared_ptr<const Dosimeter> dosimeter_;
  std::string recording_ = "run.h5";
  int branches_ = 1;  ///< number of the last; the run itself counts as the first
  std::optional<Continued> continues_;
  std::shared_ptr<EventWatch> watch_;
  PlayReport last_;
  std::vector<data::Score> scores_;
  std::string problem_;  ///< the last
};

/// Where the newest recording in the folder of a sitting can go on; none: there is none of a second or more.
std::optional<Continued> where_it_stopped(const std::string& folder);

}  // namespace ostium::app
