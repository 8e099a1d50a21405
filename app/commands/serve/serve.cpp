#include "app/commands/serve/serve.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/filled_folder.h"
#include "app/command_line/interrupt.h"
#include "app/command_line/links.h"
#include "app/command_line/passing_folder.h"
#include "app/command_line/progress.h"
#include "app/commands/run/drivers.h"
#include "app/commands/serve/sitting.h"
#include "data/catalogue/catalogue.h"
#include "data/formats/load_error.h"
#include "data/formats/paths.h"

namespace ostium::app {

namespace {

namespace fs = std::filesystem;

void declare(Options& options, ServeArguments& a) {
  a.session.script = "";
  options.add("vessel", a.session.vessel, "A case (`ostium cases`, or a file), or a closed mesh")
      .type("CASE|MESH")
      .required();
  add_session_options(options, a.session);
  options.add("--seed", a.session.seed, "0: exactly as the script says").show_default();
  options.add("--out", a.folder, "Where run.h5, the branches, notes and the report stay").type("DIR");
  options.add("--port", a.port, "0: any that is free").range(0, 65535).show_default();
  options.add("--address", a.address, "Where it listens; anything but 127.0.0.1 lets others in")
      .type("IP")
      .show_default();
  options
      .add("--hands", a.hands,
           "Who begins with the instruments: the script (until somebody takes over), or the browser")
      .one_of({"script", "browser"})
      .show_default();
  options.add("--scoring", a.scoring, "Steps and errors: a list of data/scoring, or a file")
      .type("NAME|FILE.json")
      .show_default();
  options.flag("--go", a.at_once, "Begins at once, instead of when the trainer says so");
  options.flag("--report,!--no-report", a.report, "DIR/report.html with pictures at the end (default)");
}

/// The angioplasty that is written for the case, if there is one.
std::string script_for(const std::string& vessel) {
  const std::string own = "pci-" + vessel;
  return data::is_file(fs::path(data::data_folder()) / "scripts" / (own + ".json")) ? own : "aorta-arch-wire";
}

StationSettings settings_of(const ServeArguments& a) {
  StationSettings settings;
  settings.address = a.address, settings.port = static_cast<std::uint16_t>(a.port), settings.goes_back = !a.lesson.exam;
  settings.lesson = a.lesson, settings.folder = a.folder;
  if (a.classroom) settings.server = &a.classroom->server(), settings.viewer_token = a.classroom->viewer_token();
  return settings;
}

/// The station is in its classroom, if it has one.
class Seated {
 public:
  Seated(Classroom* classroom, Station& station) : classroom_(classroom) {
    if (classroom_) classroom_->enter(station);
  }
  ~Seated() {
    if (classroom_) classroom_->leave();
  }
  Seated(const Seated&) = delete;

 private:
  Classroom* classroom_;
};

/// Branches and what a trainer noted belong to one recording, and are lost or misleading beside another.
void require_no_sitting(const std::string& folder) {
  for (const char* one : {"notes.json", "branch-2.h5"})
    if (data::is_there(fs::path(folder) / one))
      throw data::LoadError(fmt::format("{}: holds {} of another sitting; expected another folder", folder, one));
}

int run(const ServeArguments& a) {
  const Served served = serve(a);
  if (!served.problem.empty()) {
    fmt::print(stderr, "ostium serve: {}\n", served.problem);
    return 1;
  }
  return served.report.outcome == "success" || served.report.outcome == "ended" ? 0 : 1;
}

}  // namespace

Served serve(const ServeArguments& arguments) {
  ServeArguments a = arguments;
  if (a.session.script.empty()) a.session.script = script_for(a.session.vessel);
  const data::ScoreList list = data::find_score_list(a.scoring);
  RunSetup setup = setup_of(a.session);
  const bool by_hand = a.hands == "browser";
  const data::Script script = setup.script;
  if (by_hand) setup.script = free_hands(setup.script);
  std::optional<PassingFolder> passing;
  if (a.folder.empty()) a.folder = passing.emplace("serve").path();
  const FilledFolder filled(a.folder);
  if (!passing && !a.resumes) require_no_sitting(a.folder);
  if (passing) leave_no_empty({a.folder});
  const auto vessel = build_vessel(setup, "serve");
  ScriptedRun session(setup, vessel);
  LiveDriver hand(session.model, by_hand ? Hands::seats : Hands::script, 15);
  session.take_over(&hand);
  hand.end_on(interrupted);
  Checklist checklist(a.instructions, script, session.model);
  hand.follow(&checklist);
  // Dose and picture take seconds to prepare, in which there is nothing to keep yet.
  std::optional<EndsAtOnce> nothing_yet(std::in_place);
  Station station(session, hand, list, settings_of(a));
  show_progress("");
  if (!a.classroom) tell_links("trainer", station.trainer_link(), station.viewer_link(), !is_loopback(a.address));
  Sitting sitting(a, setup, session, hand, station, checklist, list);
  station.wait_for_picture();
  nothing_yet.reset();
  if (!a.at_once && !a.resumes) hand.controls(Seat::window).order(ConsoleCommand::pause);
  const Seated seated(a.classroom, station);
  Served served = sitting.play_all();
  if (!passing)
    fmt::print(stderr, "{}: {}\n", a.folder,
               served.scores.empty() ? "what was recorded until it was left"
               : a.report            ? "recordings, metrics, report.html"
                                     : "recordings, metrics");
  return served;
}

Command serve_command() {
  return make_command("serve", "A run with a trainer's station: a page in the browser",
                      {"ostium serve rca-mid-focal", "ostium serve rca-mid-focal --hands browser --out out --port 8100",
                       "ostium serve lad-proximal-eccentric --address 192.168.1.20"},
                      declare, run);
}

}  // namespace ostium::app
