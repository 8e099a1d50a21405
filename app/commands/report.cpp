#include "app/commands/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/pictures.h"
#include "app/command_line/progress.h"
#include "app/commands/side_by_side.h"
#include "app/reader/read_apart.h"
#include "app/session/run/replay.h"
#include "app/session/scene/film.h"
#include "data/assessment/page.h"
#include "data/formats/load_error.h"
#include "data/formats/png.h"
#include "data/formats/write_file.h"

namespace ostium::app {

namespace {

/// What a mark says. A hand marks during any step.
std::string words_of_mark(const data::ScriptStep& step) {
  if (step.action != data::ScriptAction::mark) return "marked by hand";
  return step.text.empty() ? step.label : step.text;
}

/// A moment worth a picture: marks of the script, the end of each injection and inflation, the last moment.
struct KeyMoment {
  std::uint64_t step;
  std::string caption;
};
std::vector<KeyMoment> key_moments(const data::RunRecord& record, const data::Script& script) {
  constexpr std::size_t most = 12;
  std::vector<KeyMoment> out;
  for (const data::RecordedEvent& e : events_of(record)) {
    const auto step = static_cast<std::uint64_t>(e.step);
    const auto of = static_cast<std::size_t>(e.value);
    if (e.code == data::EventCode::mark && of < script.steps.size())
      out.push_back({step, words_of_mark(script.steps[of])});
    if (e.code == data::EventCode::injection_ends) out.push_back({step, "contrast"});
    if (e.code == data::EventCode::deflated) out.push_back({step, "balloon empty"});
    if (e.code == data::EventCode::stent_deployed || e.code == data::EventCode::stent_elsewhere)
      out.push_back({step, "stent in the wall"});
  }
  if (out.size() >= most) {
    std::vector<KeyMoment> some;
    for (std::size_t i = 0; i < most - 1; ++i) some.push_back(out[i * out.size() / (most - 1)]);
    out = some;
  }
  out.push_back({record.steps, "the end"});
  return out;
}

std::vector<data::ReportPicture> pictures_of(Replay& replay, const data::RunRecord& record, fluoro::Renderer renderer) {
  std::vector<data::ReportPicture> out;
  FilmOptions options;
  options.renderer = renderer;
  options.pixels = 384, options.overlay = false;
  Film film(replay.model, options);
  for (const KeyMoment& moment : key_moments(record, replay.setup.script)) {
    // Recursive filter and exposure take some frames to settle.
    const double second = static_cast<double>(moment.step) * record.step_s, before = std::max(second - 0.4, 0.0);
    show_progress(fmt::format("picture at {:.1f} s", second));
    replay.go_to(before);
    fluoro::Picture last;
    while (replay.state.rods.step < moment.step && replay.tick())
      if (static_cast<double>(replay.state.rods.step) * record.step_s >= before &&
          is_frame(replay.state.rods.step, options.frames_per_s, record.step_s))
        last = film.frame(replay.model, replay.state, replay.inputs);
    if (last.grey.empty()) last = film.frame(replay.model, replay.state, replay.inputs);
    const int minute = static_cast<int>(second) / 60;
    out.push_back({fmt::format("{}:{:04.1f} {}", minute, second - 60 * minute, moment.caption), data::png_of(last)});
  }
  return out;
}

/// Takes what the run itself said at its end.
void add_end(const std::string& end, data::ReportRun& run) {
  const auto json = nlohmann::json::parse(end);
  run.outcome = json.value("outcome", ""), run.reason = json.value("reason", "");
  // Dose was accumulated during the run, over C-arm poses that the signals do not contain.
  for (const auto& metric : json.value("metrics", nlohmann::json::array()))
    for (data::Metric& mine : run.metrics)
      if (mine.name == metric.value("name", "") && metric.contains("value") && metric["value"].is_number())
        mine.value = metric["value"].get<double>();
}

data::ReportRun run_of(Replay& replay, const std::string& code, const data::ScoreList& list,
                       std::optional<fluoro::Renderer> pictures) {
  data::ReportRun run;
  run.code = code;
  run.case_name = replay.setup.vessel, run.script = replay.setup.script.name, run.seed = replay.setup.seed;
  run.software = replay.recording.software();
  run.outcome = "cut off", run.reason = "the recording has no end";
  for (const SessionTool& tool : replay.model.tools) run.tools.push_back(tool.name);
  for (const data::ScriptStep& step : replay.setup.script.steps) run.marks.push_back(words_of_mark(step));
  run.record = record_of(replay.recording, replay.model);
  run.simulated_s = static_cast<double>(run.record.steps) * run.record.step_s;
  run.metrics = metrics_of(run.record);
  try {
    if (const auto end = replay.recording.end()) add_end(*end, run);
  } catch (const nlohmann::json::exception& error) {
    throw data::LoadError(fmt::format("{}: its end cannot be read ({}); the file is damaged: copy it again",
                                      replay.recording.path(), error.what()));
  }
  run.scores = score(list, run.record, run.metrics);
  if (pictures && replay.recording.states() > 0) run.pictures = pictures_of(replay, run.record, *pictures);
  show_progress("");
  return run;
}

}  // namespace

void report_folder(const std::string& folder, std::shared_ptr<const Vessel> vessel, const std::string& recording,
                   const data::ScoreList& list, fluoro::Renderer renderer) {
  namespace fs = std::filesystem;
  const fs::path at(folder);
  Replay replay((at / recording).string(), std::move(vessel));
  const std::vector<data::ReportRun> runs = {run_of(replay, "this run", list, renderer)};
  std::vector<data::FileText> files = {{(at / "report.html").string(), report_page(runs, list)},
                                       {(at / "events.csv").string(), events_csv(runs[0])}};
  for (std::size_t i = 0; i < runs[0].pictures.size(); ++i) {
    const data::ReportPicture& p = runs[0].pictures[i];
    files.push_back({(at / "key-frames" / fmt::format("{:02}.png", i + 1)).string(), {p.png.begin(), p.png.end()}});
  }
  data::write_files(files);
}

namespace {

struct Arguments {
  std::vector<std::string> files;        ///< recordings
  std::string page = "report.html";      ///< empty: none
  std::string csv, events;               ///< empty: none
  std::string film;                      ///< of two runs; empty: none
  std::string questionnaire;             ///< empty: none
  std::string scoring = "pci-elective";  ///< a list of data/scoring, or a file
  std::vector<std::string> codes;        ///< one per recording; default: run 1, run 2, ...
  bool pictures = true;
  std::string renderer = "scanline";
};

void declare(Options& options, Arguments& a) {
  options.add("file", a.files, "What `ostium run --out` recorded; several: side by side").type("RUN.h5");
  options.add("-o,--output", a.page, "The page, which needs nothing else").type("FILE.html").show_default().writes();
  options.add("--csv", a.csv, "Metrics and ticks, a row a run").type("FILE.csv").writes();
  options.add("--film", a.film, "Two runs side by side, stage by stage: who is faster waits").type("FILE.mp4").writes();
  options.add("--events", a.events, "Events of the first run").type("FILE.csv").writes();
  options.add("--code", a.codes, "Of participants or attempts, one a recording; no names").type("CODE");
  options.add("--scoring", a.scoring, "Steps and errors: a list of data/scoring, or a file")
      .type("NAME|FILE.json")
      .show_default();
  options.add("--questionnaire", a.questionnaire, "Face and content questionnaires, a page with forms")
      .type("FILE.html")
      .writes();
  options.flag("--pictures,!--no-pictures", a.pictures, "Pictures of key moments (default)");
  add_renderer_option(options, a.renderer);
}

int run(const Arguments& a) {
  if (!a.codes.empty() && a.codes.size() != a.files.size())
    throw data::LoadError(fmt::format("{} codes for {} recordings; expected one each", a.codes.size(), a.files.size()));
  for (std::size_t i = 1; i < a.codes.size(); ++i)
    if (std::find(a.codes.begin(), a.codes.begin() + static_cast<std::ptrdiff_t>(i), a.codes[i]) !=
        a.codes.begin() + static_cast<std::ptrdiff_t>(i))
      throw data::LoadError(fmt::format("--code has {} twice; expected one of its own for each", a.codes[i]));
  if (a.files.empty()) {
    if (a.questionnaire.empty())
      throw data::LoadError("nothing to report; expected recordings RUN.h5, or --questionnaire");
    data::write_file(a.questionnaire, data::questionnaire_page());
    return 0;
  }
  if (!a.film.empty()) require_ending(a.film, {".mp4"});
  if (!a.film.empty() && a.files.size() != 2)
    throw data::LoadError(fmt::format("--film shows two runs side by side; here are {}", a.files.size()));
  const data::ScoreList list = data::find_score_list(a.scoring);
  std::vector<data::ReportRun> runs;
  for (std::size_t i = 0; i < a.files.size(); ++i) {
    show_progress("reading " + a.files[i]);
    require_whole_recording(a.files[i]);
    Replay replay(a.files[i]);
    runs.push_back(run_of(replay, a.codes.empty() ? fmt::format("run {}", i + 1) : a.codes[i], list,
                          a.pictures ? std::optional(renderer_named(a.renderer)) : std::nullopt));
  }
  // All have been read: where one is refused nothing is written.
  std::vector<data::FileText> files;
  if (!a.questionnaire.empty()) files.push_back({a.questionnaire, data::questionnaire_page()});
  if (!a.events.empty()) files.push_back({a.events, events_csv(runs[0])});
  if (!a.page.empty()) files.push_back({a.page, report_page(runs, list)});
  if (!a.csv.empty()) files.push_back({a.csv, report_csv(runs, list)});
  data::write_files(files);
  fmt::print("{}\n", a.page);
  if (a.film.empty()) return 0;
  std::array<Replay, 2> replays = {Replay(a.files[0]), Replay(a.files[1])};
  if (!film_side_by_side(replays, runs, a.film, renderer_named(a.renderer))) return 1;
  fmt::print("{}\n", a.film);
  return 0;
}

}  // namespace

Command report_command() {
  return make_command("report", "Recorded runs as a page: pictures, plots, metrics, steps, errors",
                      {"ostium report out/run.h5 -o report.html",
                       "ostium report a.h5 b.h5 --code P07-1 P07-2 -o both.html --csv both.csv",
                       "ostium report mine/run.h5 expert/run.h5 --code me expert --film both.mp4",
                       "ostium report --questionnaire forms.html"},
                      declare, run);
}

}  // namespace ostium::app
