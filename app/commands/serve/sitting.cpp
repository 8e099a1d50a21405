#include "app/commands/serve/sitting.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/command_line/interrupt.h"
#include "app/commands/report.h"
#include "app/session/run/branch.h"
#include "app/session/run/replay.h"
#include "data/formats/load_error.h"
#include "data/formats/paths.h"
#include "data/formats/read_file.h"
#include "data/formats/write_file.h"

namespace ostium::app {

namespace {

namespace fs = std::filesystem;
constexpr auto steps_a_second = static_cast<std::size_t>(data::steps_per_state);

std::string branch_name(int number) { return number == 1 ? "run.h5" : fmt::format("branch-{}.h5", number); }

int last_branch(const std::string& folder) {
  int last = 0;
  while (data::is_there(fs::path(folder) / branch_name(last + 1))) ++last;
  return last;
}

}  // namespace

std::optional<Continued> where_it_stopped(const std::string& folder) {
  for (int branch = last_branch(folder); branch >= 1; --branch) try {
      const std::string file = (fs::path(folder) / branch_name(branch)).string();
      const data::RecordingReader recording(file);
      const std::size_t states = recording.states();
      const std::size_t second = std::min(states == 0 ? 0 : states - 1, recording.steps() / steps_a_second);
      if (second > 0) return Continued{file, second * steps_a_second};
    } catch (const data::LoadError&) {
      continue;  // killed before it had begun
    }
  return {};
}

Sitting::Sitting(const ServeArguments& a, const RunSetup& setup, ScriptedRun& run, LiveDriver& hand, Station& station,
                 Checklist& checklist, const data::ScoreList& list)
    : a_(a),
      setup_(setup),
      run_(run),
      hand_(hand),
      station_(station),
      checklist_(checklist),
      list_(list),
      dosimeter_(std::make_shared<const Dosimeter>(*run.model.vessel)) {
  if (!a.resumes) return;
  branches_ = last_branch(a.folder);
  stand_at(*a.resumes);
  station_.recall(events_before(*a.resumes), recording_);
}

std::vector<SessionEvent> Sitting::events_before(const Continued& from) const {
  const data::RecordingReader recording(from.file);
  const data::RunRecord record{.step_s = recording.step_s(),
                               .steps = from.steps,
                               .signal_columns = {},
                               .signals = {},
                               .events = recording.events(),
                               .branches = {}};
  std::vector<SessionEvent> out;
  for (const data::RecordedEvent& e : events_of(record))
    if (e.step <= static_cast<double>(from.steps))
      out.push_back({static_cast<std::uint64_t>(e.step), static_cast<int>(e.code), e.tool, e.value});
  return out;
}

/// The run stands at an earlier moment, and goes on as a recording of its own.
void Sitting::stand_at(const Continued& from) {
  watch_ = go_back(run_, from);
  checklist_.go_back(events_before(from));
  continues_ = from;
  recording_ = branch_name(++branches_);
  hand_.restart(run_);
}

Served Sitting::play_all() {
  Wish wish = play_once({});
  while (wish.kind == Wish::Kind::go_back && !interrupted) wish = go_on_from(wish.second);
  return {last_, scores_, problem_};
}

/// Where it cannot, as the disk is full, the run has ended where it was left.
Wish Sitting::go_on_from(std::size_t second) {
  const std::string left = recording_;
  const int branches = branches_;
  bool begun = false;
  try {
    stand_at({(fs::path(a_.folder) / recording_).string(), second * steps_a_second});
    return play_once([&] { begun = true, station_.gone_back(second, recording_); });
  } catch (const std::runtime_error& error) {  // LoadError, WriteError
    if (begun) throw;
    note_problem(fmt::format("it cannot go on from {} s: {}", second, error.what()));
  }
  recording_ = left, branches_ = branches;
  finish((fs::path(a_.folder) / recording_).string());
  return station_.wait(interrupted);
}

void Sitting::note_problem(const std::string& what) {
  problem_ = what;
  station_.tell_problem(what);
}

/// What cannot be written is told, and the page stays.
void Sitting::keep(const std::function<void()>& what) {
  try {
    what();
  } catch (const data::LoadError& error) {
    note_problem(error.what());
  } catch (const data::WriteError& error) {
    note_problem(error.what());
  }
}

Wish Sitting::play_once(const std::function<void()>& begun) {
  PlayOptions options;
  options.begun = begun;
  options.recorder.file = (fs::path(a_.folder) / recording_).string();
  options.recorder.continues = continues_, options.recorder.watch = watch_;
  options.recorder.heard = [this, tell = station_.ear()](const SessionEvent& event) {
    checklist_.hear(event);
    tell(event);
  };
  options.recorder.failed = [this](const std::string& why) {
    station_.tell_problem("from here on nothing is recorded: " + why);
  };
  options.real = true;
  options.seconds = a_.session.seconds;
  options.dosimeter = dosimeter_;
  options.stop = &interrupted;
  last_ = play(run_, setup_, options);
  keep([this] { station_.keep_notes(); });  // however it ended
  if (!last_.problem.empty()) note_problem("the recording ends early: " + last_.problem);
  const Wish wish = station_.wish();
  if (wish.kind != Wish::Kind::none || interrupted) return wish;
  finish(options.recorder.file);
  return station_.wait(interrupted);
}

void Sitting::finish(const std::string& file) {
  scores_.assign(list_.items.size(), {});
  keep([&] { scores_ = score(list_, record_of(data::RecordingReader(file), run_.model), last_.metrics); });
  station_.ended(last_, scores_);
  if (a_.ended) keep([this] { a_.ended({last_, scores_}); });
  keep([this] {
    data::write_file((fs::path(a_.folder) / "metrics.json").string(),
                     metrics_json(setup_.vessel, setup_.seed, last_.outcome, last_.reason, last_.metrics));
  });
  if (!a_.report) return;
  keep([this] {
    report_folder(a_.folder, run_.model.vessel, recording_, list_);
    station_.reported(data::read_file((fs::path(a_.folder) / "report.html").string()));
  });
}

}  // namespace ostium::app
