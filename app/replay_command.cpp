#include "app/replay_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/session/film.h"
#include "app/session/replay.h"
#include "data/formats/dicom.h"
#include "data/formats/load_error.h"
#include "data/formats/png.h"
#include "data/formats/video.h"
#include "fluoro/views.h"

namespace ostium {

namespace {

constexpr double degree = std::numbers::pi / 180;

void say(const std::string& what) {
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "{:<100}\r", what);
}

void show_progress(const Replay& replay) {
  say(fmt::format("{:.1f} of {:.1f} s", seconds(replay.model, replay.state),
                  replay.recording.step_s() * static_cast<double>(replay.recording.steps())));
}

FilmOptions film_options(const PictureOptions& o) {
  FilmOptions film;
  if (!o.view.empty()) {
    const auto view = find_view(o.view);
    if (!view) throw LoadError("there is no view \"" + o.view + "\"; `ostium views` lists them");
    film.lao_rad = degree * view->lao_deg, film.cran_rad = degree * view->cran_deg;
  }
  if (!std::isnan(o.lao_deg)) film.lao_rad = degree * o.lao_deg;
  if (!std::isnan(o.cran_deg)) film.cran_rad = degree * o.cran_deg;
  if (!std::isnan(o.field_mm)) film.field_m = 1e-3 * o.field_mm;
  if (!o.table_mm.empty()) film.p_PI = 1e-3 * Eigen::Vector3d(o.table_mm[0], o.table_mm[1], o.table_mm[2]);
  if (o.cine) film.mode = Mode::cine;
  film.frames_per_s = o.frames_per_s;
  film.pixels = o.pixels;
  film.overlay = !o.plain;
  film.monitor = o.monitor;
  film.fill = o.fill == "left" ? Fill::left : o.fill == "right" ? Fill::right : Fill::none;
  return film;
}

constexpr double lag_s = 0.7;  // in which what a monitor shows has come up

bool is_still(const ReplayOptions& o) { return o.video.empty() && o.dicom.empty() && o.seconds == 0; }

/// Films until the recording or the time is over; of a still picture what is before it, whose lag it shows.
int make_film(const ReplayOptions& o, Replay& replay) {
  FilmOptions options = film_options(o.picture);
  if (!o.dicom.empty()) {
    options.overlay = options.monitor = false;
    if (!options.mode) options.mode = Mode::fluoroscopy;  // one header for all its frames
  }
  say("building the patient's chest");
  Film film(replay.model, options);
  std::optional<VideoWriter> writer;
  if (!o.video.empty()) writer.emplace(o.video, options.pixels, film.height(), options.frames_per_s);
  CineRun run;
  Picture last;
  const double from_s = is_still(o) ? o.from_s - lag_s : o.from_s;
  const double end_s = is_still(o) ? std::max(o.from_s, lag_s) : o.seconds > 0 ? o.from_s + o.seconds : 1e300;
  long frames = 0;
  while (seconds(replay.model, replay.state) < end_s - 1e-9 && replay.tick()) {
    film.listen(replay.model, replay.state, replay.inputs);
    const double now = seconds(replay.model, replay.state);
    if (now < from_s - 1e-9 || !is_frame(replay.state.rods.step, options.frames_per_s, replay.model.step_s())) continue;
    last = film.frame(replay.model, replay.state, replay.inputs, replay.xrays());
    ++frames;
    if (writer) writer->add(last);
    if (!o.dicom.empty()) run.frames.push_back(last);
    say(fmt::format("frame {}, {:.1f} s", frames, now));
  }
  say("");
  if (frames == 0) throw LoadError(fmt::format("{}: there is no frame from {:g} s on", o.file, o.from_s));
  if (writer && !writer->finish()) {
    fmt::print(stderr, "ostium replay: {}\n", writer->problem());
    return 1;
  }
  if (!o.dicom.empty()) {
    const CineRun header = film.run();
    run.view = header.view, run.programme = header.programme, run.exposure = header.exposure;
    write_dicom(o.dicom, run);
  }
  if (!o.png.empty()) write_png(o.png, last);
  for (const std::string& file : {o.video, o.dicom, o.png})
    if (!file.empty()) fmt::print("{}: {} frames of {}\n", file, file == o.png ? 1 : frames, replay.setup.vessel);
  return 0;
}

int check_same(const ReplayOptions& o, Replay& replay) {
  const double from_s = seconds(replay.model, replay.state);
  const VerifyReport report = verify(replay, show_progress);
  say("");
  if (o.json) {
    nlohmann::ordered_json out = {{"file", o.file},
                                  {"software", replay.recording.software()},
                                  {"from_s", from_s},
                                  {"steps", report.steps},
                                  {"same", !report.first_step}};
    if (report.first_step)
      out["first_step"] = *report.first_step, out["field"] = report.field, out["field_step"] = report.field_step;
    fmt::print("{}\n", out.dump(2));
  } else if (!report.first_step) {
    fmt::print("{}: {} steps from {:g} s on, all bit for bit as recorded\n", o.file, report.steps, from_s);
  } else {
    fmt::print("{}: differs first after step {} ({:.3f} s)\n", o.file, *report.first_step,
               replay.model.step_s() * static_cast<double>(*report.first_step));
    if (!report.field.empty())
      fmt::print("at the next recorded state, step {}, first of all: {}\n", report.field_step, report.field);
    fmt::print("recorded by {}, replayed by ostium {}\n", replay.recording.software(), OSTIUM_VERSION);
  }
  return report.first_step ? 1 : 0;
}

}  // namespace

int replay_command(const ReplayOptions& o) {
  say("building the vessel of " + o.file);
  Replay replay(o.file);
  if (!replay.recording.end() && !o.json)
    fmt::print(stderr, "ostium replay: {} was cut off after {:.3f} s; what is there is whole\n", o.file,
               replay.recording.step_s() * static_cast<double>(replay.recording.steps()));
  replay.go_to(o.from_s);
  int code = 0;
  const bool film = !o.video.empty() || !o.dicom.empty() || !o.png.empty();
  if (o.verify || !film) code = check_same(o, replay);
  if (!film) return code;
  // Strips show what was before, too.
  const double before_s = std::max(is_still(o) ? lag_s : 0, o.picture.monitor ? monitor_s : 0);
  replay.go_to(std::max(0.0, o.from_s - before_s));
  return std::max(code, make_film(o, replay));
}

}  // namespace ostium
