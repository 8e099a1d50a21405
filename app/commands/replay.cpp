#include "app/session/run/replay.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/interrupt.h"
#include "app/command_line/pictures.h"
#include "app/command_line/progress.h"
#include "app/reader/read_apart.h"
#include "app/session/scene/angioscopy.h"
#include "app/session/scene/film.h"
#include "core/base/units.h"
#include "data/formats/dicom/dicom_runs.h"
#include "data/formats/load_error.h"
#include "data/formats/png.h"
#include "data/formats/video.h"
#include "fluoro/detector/exposure.h"
#include "fluoro/projection/c_arm.h"
#include "fluoro/projection/views.h"

namespace ostium::app {

namespace {

/// How the pictures differ from what the run showed.
struct PictureArguments {
  ViewArguments view;  ///< empty: the run's view
  double field_mm = ViewArguments::as_view;
  std::vector<double> table_mm;  ///< empty: the run's table position
  int pixels = 512;
  bool cine = false, plain = false;  ///< plain: without overlay
  bool monitor = false;              ///< ECG, pressure and gauge below the picture
  double frames_per_s = 15;
  std::string fill = "none", renderer = "scanline";

  /// Whether something was asked for that only a picture shows.
  bool asked_for() const {
    return !view.view.empty() || !std::isnan(view.lao_deg) || !std::isnan(view.cran_deg) || !std::isnan(field_mm) ||
           !table_mm.empty() || cine || plain || monitor || fill != "none" || renderer != "scanline" ||
           pixels != PictureArguments().pixels || frames_per_s != PictureArguments().frames_per_s;
  }
};

struct Arguments {
  std::string file;
  bool verify = false;
  double from_s = 0, seconds = 0;  ///< `seconds` 0: to the end
  std::string video, dicom, png;   ///< file names; empty: none
  std::string inside;              ///< of `png`: seen from inside an artery, into this branch
  PictureArguments picture;
  bool json = false;

  bool films() const { return !video.empty() || !dicom.empty(); }
  bool shows() const { return films() || !png.empty(); }
};

void declare_picture(Options& options, PictureArguments& a) {
  options.add("--view", a.view.view, "Standard view (`ostium views`), instead of the run's").type("VIEW");
  add_angle_options(options, a.view);
  options.add("--field", a.field_mm, "Side of the detector's field, mm").range(50.0, 400.0);
  options.add("--table", a.table_mm, "Isocentre in the patient: left, head, front, mm")
      .count(3)
      .range(-table_reach_mm, table_reach_mm);
  add_pixels_option(options, a.pixels, 64);
  add_cine_flag(options, a.cine);
  add_renderer_option(options, a.renderer);
  options.flag("--plain", a.plain, "Without angles, times and dose on the picture");
  options.flag("--monitor", a.monitor, "ECG, pressure and gauge under the picture");
  add_frame_rate_option(options, "--rate", a.frames_per_s);
  add_fill_option(options, a.fill);
}

void declare(Options& options, Arguments& a) {
  options.add("file", a.file, "What `ostium run --out` recorded").type("RUN.h5").required();
  options.flag("--verify", a.verify, "Compare every step; the default where no picture is asked for");
  options.add("--from", a.from_s, "Second to begin at").not_negative();
  options.add("--seconds", a.seconds, "Length of the film").positive();
  options.add("--video", a.video, "Film it").type("FILE.mp4").writes();
  options.add("--dicom", a.dicom, "Film it; each change of view, field or mode begins FILE-2.dcm, ...")
      .type("FILE.dcm")
      .writes();
  options.add("--png", a.png, "One picture, at --from").type("FILE.png").writes();
  options.add("--inside", a.inside, "The picture is no X-ray, but what a camera in the artery sees of a branch's mouth")
      .type("BRANCH");
  declare_picture(options, a.picture);
  add_json_flag(options, a.json);
}

using units::degree;

void show_share(const Replay& replay) {
  show_progress(fmt::format("{:.1f} of {:.1f} s", seconds(replay.model, replay.state),
                            replay.recording.step_s() * static_cast<double>(replay.recording.steps())));
}

FilmOptions film_options(const PictureArguments& a) {
  FilmOptions film;
  if (!a.view.view.empty()) {
    const fluoro::StandardView view = named_view(a.view.view);
    film.lao_rad = degree * view.lao_deg, film.cran_rad = degree * view.cran_deg;
  }
  if (!std::isnan(a.view.lao_deg)) film.lao_rad = degree * a.view.lao_deg;
  if (!std::isnan(a.view.cran_deg)) film.cran_rad = degree * a.view.cran_deg;
  if (!std::isnan(a.field_mm)) film.field_m = 1e-3 * a.field_mm;
  if (!a.table_mm.empty()) film.p_PI = 1e-3 * Eigen::Vector3d(a.table_mm[0], a.table_mm[1], a.table_mm[2]);
  if (a.cine) film.mode = fluoro::Mode::cine;
  film.frames_per_s = a.frames_per_s;
  film.pixels = a.pixels;
  film.overlay = !a.plain;
  film.monitor = a.monitor;
  film.fill = fill_named(a.fill);
  film.renderer = renderer_named(a.renderer);
  return film;
}

constexpr double lag_s = 0.7;  // time for the display's recursive filter to settle

using Json = nlohmann::ordered_json;

/// One picture, of the first frame from `at_s` on, or else of the last that there is.
struct Still {
  double at_s = -1, shown_s = -1;
  fluoro::Picture picture;

  bool waits() const { return shown_s < at_s - 1e-9; }
  void look(double now, const fluoro::Picture& seen) {
    if (waits()) shown_s = now, picture = seen;
  }
};

/// Films until the recording or the time ends; a still picture needs the preceding frames, whose lag it shows.
/// `told` gets what was written.
int make_film(const Arguments& a, Replay& replay, Json& told) {
  FilmOptions options = film_options(a.picture);
  if (options.monitor && !replay.model.has_patient())
    throw data::LoadError(a.file + ": --monitor shows ECG and pressure, and no blood flows in these vessels");
  if (!a.dicom.empty()) options.overlay = options.monitor = false;
  show_progress("building the patient's chest");
  Film film(replay.model, options);
  std::optional<data::VideoWriter> writer;
  if (!a.video.empty()) writer.emplace(a.video, options.pixels, film.height(), options.frames_per_s);
  data::DicomRuns runs;
  Still still;
  if (!a.png.empty()) {
    still.at_s = a.from_s;
    // Near the beginning the lag settles on what is seen there.
    if (!a.films())
      for (double s = a.from_s; s < lag_s; s += 1 / options.frames_per_s)
        film.frame(replay.model, replay.state, replay.inputs, replay.xrays());
  }
  const auto anchor = std::llround(a.from_s / replay.model.step_s());  // of the frames: there is one at --from
  const double begin_s = a.png.empty() ? a.from_s : a.from_s - lag_s;
  const double end_s = !a.films() ? 0 : a.seconds > 0 ? a.from_s + a.seconds : 1e300;
  long frames = 0;
  if (a.films()) stop_on_signals();  // a film ends with the frames that it has
  do {
    film.listen(replay.model, replay.state, replay.inputs);
    const double now = seconds(replay.model, replay.state);
    const auto from_anchor = std::llabs(static_cast<long long>(replay.state.rods.step) - anchor);
    if (now < begin_s - 1e-9 ||
        !is_frame(static_cast<std::uint64_t>(from_anchor), options.frames_per_s, replay.model.step_s()))
      continue;
    const fluoro::Picture seen = film.frame(replay.model, replay.state, replay.inputs, replay.xrays());
    still.look(now, seen);
    if (now < a.from_s - 1e-9 || now > end_s + 1e-9) continue;
    ++frames;
    if (writer) writer->add(seen);
    if (!a.dicom.empty()) runs.add(film.run(), seen);
    show_progress(fmt::format("frame {}, {:.1f} s", frames, now));
  } while ((seconds(replay.model, replay.state) < end_s - 1e-9 || still.waits()) && !interrupted && replay.tick());
  show_progress("");
  const bool nothing = a.films() ? frames == 0 : still.shown_s < 0;
  if (nothing && interrupted) return 1;
  if (nothing) throw data::LoadError(fmt::format("{}: there is no frame from {:g} s on", a.file, a.from_s));
  if (!finish_film(writer, "replay")) return 1;
  const auto tell = [&](const std::string& file, std::size_t of) {
    told["pictures"].push_back({{"file", file}, {"frames", of}});
    if (!a.json) fmt::print("{}: {} frames of {}\n", file, of, replay.setup.vessel);
  };
  if (!a.dicom.empty()) {
    const std::vector<std::string> names = runs.write(a.dicom);
    for (std::size_t n = 0; n < names.size(); ++n) tell(names[n], runs.runs()[n].frames.size());
  }
  if (writer) tell(a.video, static_cast<std::size_t>(frames));
  if (const double last_s = seconds(replay.model, replay.state);
      a.films() && a.seconds > 0 && !interrupted && last_s < end_s - 1e-9 && !a.json)
    fmt::print("The recording ends at {:.1f} s, before the {:g} s that were asked for.\n", last_s, a.seconds);
  if (a.png.empty() || still.shown_s < 0) return 0;
  data::write_png(a.png, still.picture);
  told["pictures"].push_back({{"file", a.png}, {"at_s", still.shown_s}});
  if (!a.json) fmt::print("{}: {} at {:.3f} s\n", a.png, replay.setup.vessel, still.shown_s);
  return 0;
}

/// `told` gets the result.
int check_same(const Arguments& a, Replay& replay, Json& told) {
  const double from_s = seconds(replay.model, replay.state);
  const VerifyReport report = verify(replay, show_share);
  if (report.steps == 0 && from_s > 0)
    throw data::LoadError(fmt::format("{}: no step comes after {:g} s; there is nothing to verify", a.file, from_s));
  show_progress("");
  told["from_s"] = from_s, told["steps"] = report.steps, told["same"] = !report.first_step;
  if (report.first_step)
    told["first_step"] = *report.first_step, told["field"] = report.field, told["field_step"] = report.field_step;
  if (a.json) return report.first_step ? 1 : 0;
  if (!report.first_step) {
    fmt::print("{}: {} steps from {:g} s on, all bit for bit as recorded\n", a.file, report.steps, from_s);
  } else {
    fmt::print("{}: differs first after step {} ({:.3f} s)\n", a.file, *report.first_step,
               replay.model.step_s() * static_cast<double>(*report.first_step));
    if (!report.field.empty())
      fmt::print("at the next recorded state, step {}, first of all: {}\n", report.field_step, report.field);
    fmt::print("recorded by {}, replayed by ostium {}\n", replay.recording.software(), OSTIUM_VERSION);
  }
  return report.first_step ? 1 : 0;
}

/// `told` gets what was written.
int look_inside(const Arguments& a, const Replay& replay, Json& told) {
  if (!replay.model.has_patient())
    throw data::LoadError(
        a.file +
        ": --inside looks from one coronary artery into another, and these vessels have none: a mesh, "
        "or a case in which no heart was recognised");
  show_progress("looking into " + a.inside);
  const Angioscopy seen = look_inside(replay.model, replay.state, a.inside, a.picture.pixels);
  show_progress("");
  data::write_rgb_png(a.png, seen.pixels, seen.pixels, seen.rgb);
  const double at_s = seconds(replay.model, replay.state);
  told["pictures"].push_back({{"file", a.png}, {"at_s", at_s}});
  if (!a.json) fmt::print("{}: {} at {:.3f} s\n", a.png, a.inside, at_s);
  return 0;
}

/// Before the vessel is built, which takes seconds.
void require_arguments(const Arguments& a) {
  if (!a.video.empty()) require_ending(a.video, {".mp4"});
  if (!a.dicom.empty()) require_ending(a.dicom, {".dcm"}), data::require_dicom();
  if (!a.png.empty()) require_ending(a.png, {".png"});
  if (!a.inside.empty() && (a.png.empty() || a.films() || a.verify))
    throw data::LoadError("--inside is one picture; expected --png FILE.png with it, and neither a film nor --verify");
  if (!a.films() && a.seconds > 0)
    throw data::LoadError("--seconds is the length of a film; expected --video FILE.mp4 or --dicom FILE.dcm with it");
  if (!a.shows() && a.picture.asked_for())
    throw data::LoadError(
        "there is no picture to show that in; expected --png FILE.png, --video FILE.mp4 or --dicom FILE.dcm with it");
  const FilmOptions film = film_options(a.picture);
  fluoro::CArm arm;
  arm.lao_rad = film.lao_rad.value_or(0), arm.cran_rad = film.cran_rad.value_or(0);
  require_reachable(arm);
  fluoro::require_rate(film.frames_per_s);
}

/// Exit code: 0 if everything was done and, with `verify`, the replay is identical.
int run(const Arguments& a) {
  require_arguments(a);
  require_whole_recording(a.file);
  require_within(data::RecordingReader(a.file), a.from_s);
  show_progress("building the vessel of " + a.file);
  Replay replay(a.file);
  if (!replay.recording.end() && !a.json)
    fmt::print(stderr, "ostium replay: {} was cut off after {:.3f} s; what is there is whole\n", a.file,
               replay.recording.step_s() * static_cast<double>(replay.recording.steps()));
  replay.go_to(a.from_s);
  Json told = {{"file", a.file}, {"software", replay.recording.software()}};
  int code = 0;
  if (a.verify || !a.shows()) code = check_same(a, replay, told);
  if (!a.inside.empty()) {
    code = look_inside(a, replay, told);
  } else if (a.shows()) {
    // Strips also show the seconds before.
    const double before_s = std::max(a.png.empty() ? 0 : lag_s, a.picture.monitor ? monitor_s : 0);
    replay.go_to(std::max(0.0, a.from_s - before_s));
    code = std::max(code, make_film(a, replay, told));
  }
  if (a.json) fmt::print("{}\n", told.dump(2));
  return code;
}

}  // namespace

Command replay_command() {
  return make_command(
      "replay", "A recorded run once more: whether it is the same, and pictures",
      {"ostium replay out/run.h5 --verify", "ostium replay out/run.h5 --from 12.5 --view spider --video out.mp4",
       "ostium replay out/run.h5 --from 8 --lao 40 --cran 0 --png moment.png",
       "ostium replay out/run.h5 --from 355 --inside D1 --png cell.png"},
      declare, run);
}

}  // namespace ostium::app
