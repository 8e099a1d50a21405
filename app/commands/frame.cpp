#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/interrupt.h"
#include "app/command_line/patient_options.h"
#include "app/command_line/pictures.h"
#include "app/command_line/progress.h"
#include "app/session/scene/xray_scene.h"
#include "core/base/units.h"
#include "data/formats/dicom/dicom.h"
#include "data/formats/load_error.h"
#include "data/formats/png.h"
#include "data/formats/video.h"
#include "fluoro/console/fluoroscope.h"
#include "fluoro/display/overlay.h"
#include "fluoro/phantom/chest.h"
#include "fluoro/projection/views.h"
#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::app {

namespace {

using units::degree;

struct Arguments {
  std::string of = "phantom";    ///< the object: "phantom", or a case
  std::vector<std::string> set;  ///< of a case: which person
  std::optional<double> phase;   ///< cardiac phase of a case; a film starts there; usual: 0.75
  ViewArguments view{.view = "ap"};
  double sid_mm = 1100, field_mm = 200;
  std::vector<double> table_mm{0, 0, 0};  ///< isocentre in the patient: left, head, front
  std::vector<double> shutters{0.474, 0.474, 0.474,
                               0.474};  ///< left, right, top, bottom, as shares of the picture's side
  int pixels = 512;
  bool cine = false;
  double frames_per_s = 15;
  int frames = 0;                          ///< 0: 8 frames before a still picture, 30 for a video
  std::string fill = "none";               ///< left, right: coronary tree full of contrast
  std::optional<double> stenosis_percent;  ///< usual: 60
  std::string guide;                       ///< vessel that holds guide and wire: left, right, none; empty: left
  std::uint64_t seed = 1;
  std::string renderer = "scanline";
  bool overlay = false, json = false;
  std::string out = "frame.png";  ///< .png, .dcm or .mp4

  bool video() const { return vascular::ending_of(out) == ".mp4"; }
  bool dicom() const { return vascular::ending_of(out) == ".dcm"; }
  fluoro::Programme programme() const { return cine ? fluoro::cine(frames_per_s) : fluoro::fluoroscopy(frames_per_s); }
};

void declare_geometry(Options& options, Arguments& a) {
  options.add("--view", a.view.view, "Standard view (`ostium views`), or one of the case's").show_default();
  add_angle_options(options, a.view);
  options.add("--sid", a.sid_mm, "Source to detector, mm").show_default();
  options.add("--field", a.field_mm, "Side of the detector's field, mm: 200, 160, 130")
      .range(50.0, 400.0)
      .show_default();
  options.add("--table", a.table_mm, "Isocentre from the heart's middle: left, head, front, mm")
      .count(3)
      .range(-table_reach_mm, table_reach_mm);
  options.add("--shutters", a.shutters, "Left, right, top, bottom, from the middle; 0.5 is open; 0.474 else").count(4);
  add_pixels_option(options, a.pixels, 64);
}

void declare(Options& options, Arguments& a) {
  options.add("of", a.of, "What is in the beam: a case (`ostium cases`), or phantom: fluoro's test chest")
      .show_default();
  add_patient_option(options, a.set);
  options.add("--phase", a.phase, "Of a case's heart, 0 is the R wave; a film begins there (0.75)").range(0.0, 1.0);
  declare_geometry(options, a);
  add_cine_flag(options, a.cine);
  add_frame_rate_option(options, "--rate", a.frames_per_s);
  options.add("--frames", a.frames, "So many; of a still picture the last is shown (8)").range(1, 10'000);
  add_fill_option(options, a.fill);
  options.add("--stenosis", a.stenosis_percent, "Of the phantom's LAD and RCA, by diameter, % (60)").range(0.0, 99.0);
  options.add("--guide", a.guide, "Where the phantom's guide and wire are (left)").one_of({"left", "right", "none"});
  options.add("--seed", a.seed, "Of the noise").show_default();
  add_renderer_option(options, a.renderer);
  options.flag("--overlay", a.overlay, "Angles, rate, times and dose on the picture (not in DICOM)");
  options.flag("--json", a.json, "Exposure and dose, machine-readable, see data/schemas/frame.schema.json");
  options.add("-o,--out", a.out, "FILE.png, FILE.dcm or FILE.mp4").show_default().writes();
}

fluoro::View view_of(const Arguments& a, const std::vector<data::CaseView>& own) {
  const fluoro::StandardView named = named_view(a.view.view, own);
  fluoro::View view;
  view.arm.lao_rad = degree * (std::isnan(a.view.lao_deg) ? named.lao_deg : a.view.lao_deg);
  view.arm.cran_rad = degree * (std::isnan(a.view.cran_deg) ? named.cran_deg : a.view.cran_deg);
  view.arm.source_to_detector_m = 1e-3 * a.sid_mm;
  view.arm.p_PI = 1e-3 * Eigen::Vector3d(a.table_mm[0], a.table_mm[1], a.table_mm[2]);
  view.field_m = 1e-3 * a.field_mm;
  view.pixels = a.pixels;
  return view;
}

/// The scene of each frame.
using Scenes = std::function<fluoro::Scene(int frame)>;

Scenes phantom_scenes(const Arguments& a) {
  fluoro::phantom::ChestOptions chest;
  chest.filling = a.fill == "left"    ? fluoro::phantom::Filling::left
                  : a.fill == "right" ? fluoro::phantom::Filling::right
                                      : fluoro::phantom::Filling::none;
  chest.stenosis = 0.01 * a.stenosis_percent.value_or(60);
  chest.instruments = a.guide != "none";
  chest.left_instruments = (a.guide.empty() || a.guide == "left");
  return [scene = fluoro::phantom::chest(chest)](int) { return scene; };
}

/// A case's patient, with the heart beating from frame to frame. Sets `middle` to the C-arm's isocentre.
Scenes patient_scenes(const Arguments& a, const data::Case& c, Eigen::Vector3d& middle) {
  show_progress("building " + a.of);
  const CaseScene made = scene_of_case(c, fill_named(a.fill), middle);
  const double step_s = 1 / a.frames_per_s;
  return [made, step_s, phase = a.phase.value_or(0.75), at = 0](int frame) mutable {
    for (; at < frame; ++at) phase = made.later(phase, step_s);
    return made.at(phase);
  };
}

/// The frames taken one after the other.
struct FilmedFrames {
  fluoro::FluoroscopeState state;
  fluoro::FrameReport report;
  std::vector<fluoro::Picture> kept;  ///< for DICOM
  long most_leaking = 0;              ///< pixels of a frame in which a surface is open; a few cannot be seen
  std::string leaking;                ///< names of the bodies that leaked first
  std::string renderer, device;       ///< what drew them
};

void print_numbers(const Arguments& a, const fluoro::FluoroscopeInput& in, const FilmedFrames& filmed) {
  const fluoro::Exposure& e = filmed.report.exposure;
  const double rate = a.frames_per_s;
  if (a.json) {
    const nlohmann::ordered_json numbers = {{"lao_deg", in.view.arm.lao_rad / degree},
                                            {"cran_deg", in.view.arm.cran_rad / degree},
                                            {"tube_kV", e.tube.peak_kV},
                                            {"copper_mm", e.tube.copper_mm},
                                            {"patient_mm", 1e3 * e.patient_m},
                                            {"detector_dose_nGy", e.detector_dose_nGy},
                                            {"kerma_per_frame_mGy", 1e3 * e.kerma_Gy},
                                            {"dap_per_frame_Gy_cm2", 1e4 * e.dose_area_Gy_m2},
                                            {"kerma_rate_mGy_min", 6e4 * e.kerma_Gy * rate},
                                            {"frames", filmed.state.imager.frame},
                                            {"renderer", filmed.renderer},
                                            {"device", filmed.device},
                                            {"file", a.out}};
    fmt::print("{}\n", numbers.dump(2));
    return;
  }
  fmt::print("{}, {:.0f} kV, {:.1f} mm Cu, patient as {:.1f} cm of soft tissue, {:.0f} nGy at the detector\n",
             fluoro::angles_text(in.view.arm.lao_rad / degree, in.view.arm.cran_rad / degree), e.tube.peak_kV,
             e.tube.copper_mm, 100 * e.patient_m, e.detector_dose_nGy);
  fmt::print("a frame {:.4f} mGy and {:.4f} Gy cm2; at {:g} frames/s {:.1f} mGy/min\n{}\n", 1e3 * e.kerma_Gy,
             1e4 * e.dose_area_Gy_m2, rate, 6e4 * e.kerma_Gy * rate, a.out);
}

fluoro::Picture shown(const Arguments& a, const fluoro::FluoroscopeInput& in, const fluoro::FluoroscopeState& state,
                      const fluoro::FrameReport& report) {
  fluoro::Picture picture = state.live;
  if (a.overlay) draw_overlay({in.view, a.programme(), report.exposure, state.dose, true, "", a.of}, picture);
  return picture;
}

/// A picture with more leaking pixels than either is spoiled; fewer, as where two vessels of an imported mesh touch,
/// are told and not seen.
constexpr double spoiled_share = 1e-3, spoiled_pixels = 20;

FilmedFrames film(const Arguments& a, const Scenes& scenes, const fluoro::FluoroscopeInput& in, fluoro::Scene& scene,
                  std::optional<data::VideoWriter>& writer) {
  FilmedFrames out;
  fluoro::Imager imager({}, fluoro::make_renderer(renderer_named(a.renderer)));
  out.renderer = imager.renderer().name(), out.device = imager.renderer().device();
  fluoro::DisplayScratch scratch;
  const int frames = a.frames ? a.frames : a.video() ? 30 : 8;
  // A still picture stays at its phase; the frames before it only build up the lag.
  const bool moves = a.video() || (a.dicom() && a.frames);
  if (moves) stop_on_signals();  // a film ends with the frames that it has
  for (int i = 0; i < frames && !interrupted; ++i) {
    if (moves) scene = scenes(i);
    out.report = tick(imager, in, out.state, scratch).frame;
    if (out.report.leak && out.leaking.empty())
      out.leaking = imager.leaking({scene, in.view, in.collimator, a.programme(), in.seed});
    if (const auto& leak = out.report.leak;
        leak && static_cast<double>(leak.pixels) > std::max(spoiled_pixels, spoiled_share * a.pixels * a.pixels))
      throw data::LoadError(
          fmt::format("X-ray scene: {} of {} pixels leak (worst {:.2f} mm): {}; mend that mesh "
                      "(ostium check), or import it again",
                      leak.pixels, a.pixels * a.pixels, 1e3 * double(leak.worst_m), out.leaking));
    out.most_leaking = std::max(out.most_leaking, out.report.leak.pixels);
    if (writer) writer->add(shown(a, in, out.state, out.report));
    if (a.dicom() && (a.frames || i + 1 == frames)) out.kept.push_back(out.state.live);
    show_progress(fmt::format("frame {} of {}", i + 1, frames));
  }
  show_progress("");
  return out;
}

int run(const Arguments& a) {
  require_ending(a.out, {".png", ".dcm", ".mp4"});
  fluoro::require_rate(a.frames_per_s);
  if (a.dicom() && std::uint64_t(a.frames) * std::uint64_t(a.pixels * a.pixels) > data::dicom_most_bytes)
    throw data::LoadError(
        fmt::format("--frames {} of {} pixels a side are more than the 4 GB of a DICOM file; "
                    "expected at most {}",
                    a.frames, a.pixels, data::dicom_most_bytes / std::uint64_t(a.pixels * a.pixels)));
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  if (a.of == "phantom" && (!a.set.empty() || a.phase))
    throw data::LoadError(std::string(a.phase ? "--phase" : "--set") + " is for a case; the phantom is nobody");
  if (a.of != "phantom" && (a.stenosis_percent || !a.guide.empty()))
    throw data::LoadError(std::string(a.stenosis_percent ? "--stenosis" : "--guide") +
                          " is for the phantom; a case has lesions of its own, and no tools");
  std::optional<data::Case> of;
  if (a.of != "phantom") of = case_with(a.of, a.set);
  fluoro::View view = view_of(a, of ? of->views : std::vector<data::CaseView>{});
  require_reachable(view.arm);
  const Scenes scenes = of ? patient_scenes(a, *of, middle) : phantom_scenes(a);
  view.arm.p_PI += middle;
  fluoro::Scene scene = scenes(0);
  check(scene);
  const fluoro::FluoroscopeInput in{.scene = scene,
                                    .view = view,
                                    .collimator = {a.shutters[0], a.shutters[1], a.shutters[2], a.shutters[3]},
                                    .pedals = {.fluoroscopy = !a.cine, .cine = a.cine},
                                    .fluoroscopy_per_s = a.frames_per_s,
                                    .cine_per_s = a.frames_per_s,
                                    .seed = a.seed};
  std::optional<data::VideoWriter> writer;
  if (a.video()) writer.emplace(a.out, a.pixels, a.pixels, a.frames_per_s);
  const FilmedFrames filmed = film(a, scenes, in, scene, writer);
  if (!finish_film(writer, "frame")) return 1;
  if (a.dicom() && filmed.kept.empty()) return 1;  // it was ended before the first
  if (a.dicom())
    data::write_dicom(a.out, fluoro::CineRun{view, a.programme(), filmed.report.exposure, filmed.kept});
  else if (!a.video())
    data::write_png(a.out, shown(a, in, filmed.state, filmed.report));
  print_numbers(a, in, filmed);
  if (filmed.most_leaking > 0)
    fmt::print(stderr, "ostium frame: {} of {} pixels lie where a surface is open ({}); they are too few to be seen\n",
               filmed.most_leaking, a.pixels * a.pixels, filmed.leaking);
  return 0;
}

}  // namespace

Command frame_command() {
  return make_command(
      "frame", "One X-ray picture, or a short run of them",
      {"ostium frame --view spider --fill left -o spider.png",
       "ostium frame --lao -30 --cran -20 --cine --pixels 1024 --fill left --overlay -o cine.png",
       "ostium frame --view lao --fill right --guide right --frames 15 -o run.dcm",
       "ostium frame lad-proximal-eccentric --set person=4 --view spider --fill left --cine -o case.png"},
      declare, run);
}

}  // namespace ostium::app
