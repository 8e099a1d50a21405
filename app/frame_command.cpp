#include "app/frame_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/session/xray_scene.h"
#include "data/formats/dicom.h"
#include "data/formats/load_error.h"
#include "data/formats/png.h"
#include "data/formats/video.h"
#include "fluoro/fluoroscope.h"
#include "fluoro/overlay.h"
#include "fluoro/phantom/chest.h"
#include "fluoro/views.h"

namespace ostium {

namespace {

constexpr double degree = std::numbers::pi / 180;

bool ends_with(const std::string& file, const char* ending) { return file.ends_with(ending); }

View view_of(const FrameOptions& o) {
  const auto named = find_view(o.view);
  if (!named) throw LoadError("there is no view \"" + o.view + "\"; `ostium views` lists them");
  View view;
  view.arm.lao_rad = degree * (std::isnan(o.lao_deg) ? named->lao_deg : o.lao_deg);
  view.arm.cran_rad = degree * (std::isnan(o.cran_deg) ? named->cran_deg : o.cran_deg);
  view.arm.source_to_detector_m = 1e-3 * o.sid_mm;
  view.arm.p_PI = 1e-3 * Eigen::Vector3d(o.table_mm[0], o.table_mm[1], o.table_mm[2]);
  view.field_m = 1e-3 * o.field_mm;
  view.pixels = o.pixels;
  return view;
}

/// What is in the beam, frame by frame.
using Scenes = std::function<Scene(int frame)>;

Scenes phantom_scenes(const FrameOptions& o) {
  phantom::ChestOptions chest;
  chest.filling = o.fill == "left"    ? phantom::Filling::left
                  : o.fill == "right" ? phantom::Filling::right
                                      : phantom::Filling::none;
  chest.stenosis = 0.01 * o.stenosis_percent;
  chest.instruments = o.guide != "none";
  chest.left_instruments = o.guide == "left";
  return [scene = phantom::chest(chest)](int) { return scene; };
}

/// A case's patient; the heart beats from frame to frame. `middle` is where the C-arm looks.
Scenes patient_scenes(const FrameOptions& o, Eigen::Vector3d& middle) {
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "building {}\r", o.of);
  const CaseScene made = scene_of_case(o.of,
                                       o.fill == "left"    ? Fill::left
                                       : o.fill == "right" ? Fill::right
                                                           : Fill::none,
                                       middle);
  const double step_s = 1 / o.frames_per_s;
  return [made, step_s, phase = o.phase, at = 0](int frame) mutable {
    for (; at < frame; ++at) phase = made.later(phase, step_s);
    return made.at(phase);
  };
}

void print_numbers(const FrameOptions& o, const FluoroscopeInput& in, const FluoroscopeState& state,
                   const FrameReport& report) {
  const Exposure& e = report.exposure;
  const double rate = o.frames_per_s;
  if (o.json) {
    const nlohmann::ordered_json numbers = {{"lao_deg", in.view.arm.lao_rad / degree},
                                            {"cran_deg", in.view.arm.cran_rad / degree},
                                            {"tube_kV", e.tube.peak_kV},
                                            {"copper_mm", e.tube.copper_mm},
                                            {"patient_mm", 1e3 * e.patient_m},
                                            {"detector_dose_nGy", e.detector_dose_nGy},
                                            {"kerma_per_frame_mGy", 1e3 * e.kerma_Gy},
                                            {"dap_per_frame_Gy_cm2", 1e4 * e.dose_area_Gy_m2},
                                            {"kerma_rate_mGy_min", 6e4 * e.kerma_Gy * rate},
                                            {"frames", state.imager.frame},
                                            {"file", o.out}};
    fmt::print("{}\n", numbers.dump(2));
    return;
  }
  fmt::print("{}, {:.0f} kV, {:.1f} mm Cu, patient as {:.1f} cm of soft tissue, {:.0f} nGy at the detector\n",
             angles_text(in.view.arm.lao_rad / degree, in.view.arm.cran_rad / degree), e.tube.peak_kV, e.tube.copper_mm,
             100 * e.patient_m, e.detector_dose_nGy);
  fmt::print("a frame {:.4f} mGy and {:.4f} Gy cm2; at {:g} frames/s {:.1f} mGy/min\n{}\n", 1e3 * e.kerma_Gy,
             1e4 * e.dose_area_Gy_m2, rate, 6e4 * e.kerma_Gy * rate, o.out);
}

Picture shown(const FrameOptions& o, const FluoroscopeInput& in, const FluoroscopeState& state,
              const FrameReport& report) {
  Picture picture = state.live;
  if (o.overlay)
    draw_overlay({in.view, o.cine ? cine(o.frames_per_s) : fluoroscopy(o.frames_per_s), report.exposure, state.dose,
                  true, "", o.of},
                 picture);
  return picture;
}

}  // namespace

int frame_command(const FrameOptions& o) {
  const bool video = ends_with(o.out, ".mp4"), dicom = ends_with(o.out, ".dcm");
  if (!video && !dicom && !ends_with(o.out, ".png"))
    throw LoadError(o.out + ": what is it to be? .png, .dcm and .mp4 are known");
  View view = view_of(o);
  require_reachable(view.arm);
  require_rate(o.frames_per_s);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  const Scenes scenes = o.of == "phantom" ? phantom_scenes(o) : patient_scenes(o, middle);
  view.arm.p_PI += middle;
  Scene scene = scenes(0);
  check(scene);
  const FluoroscopeInput in{.scene = scene,
                            .view = view,
                            .collimator = {o.shutters[0], o.shutters[1], o.shutters[2], o.shutters[3]},
                            .pedals = {.fluoroscopy = !o.cine, .cine = o.cine},
                            .fluoroscopy_per_s = o.frames_per_s,
                            .cine_per_s = o.frames_per_s,
                            .seed = o.seed};
  Imager imager({}, o.renderer == "osmesa" ? make_osmesa_renderer() : make_scanline_renderer());
  FluoroscopeState state;
  DisplayScratch scratch;
  FrameReport report;
  CineRun run{view, o.cine ? cine(o.frames_per_s) : fluoroscopy(o.frames_per_s), {}, {}};
  std::optional<VideoWriter> writer;
  if (video) writer.emplace(o.out, o.pixels, o.pixels, o.frames_per_s);
  const int frames = o.frames ? o.frames : video ? 30 : 8;
  // A still picture stands at its phase; the frames before it only feed the lag.
  const bool moves = video || (dicom && o.frames);
  for (int i = 0; i < frames; ++i) {
    if (moves) scene = scenes(i);
    report = tick(imager, in, state, scratch).frame;
    if (report.leak)
      throw LoadError(fmt::format("X-ray scene: {} pixels leak (worst {:.2f} mm): {}", report.leak.pixels,
                                  1e3 * double(report.leak.worst_m), report.leaking));
    if (writer) writer->add(shown(o, in, state, report));
    if (dicom && (o.frames || i + 1 == frames)) run.frames.push_back(state.live);
    if (isatty(STDERR_FILENO)) fmt::print(stderr, "frame {} of {}\r", i + 1, frames);
  }
  if (writer && !writer->finish()) {
    fmt::print(stderr, "ostium frame: {}\n", writer->problem());
    return 1;
  }
  run.exposure = report.exposure;
  if (dicom) write_dicom(o.out, run);
  if (!dicom && !video) write_png(o.out, shown(o, in, state, report));
  print_numbers(o, in, state, report);
  return 0;
}

int views_command(bool json) {
  if (json) {
    auto array = nlohmann::ordered_json::array();
    for (const StandardView& v : standard_views())
      array.push_back({{"view", v.name}, {"lao_deg", v.lao_deg}, {"cran_deg", v.cran_deg}, {"shows", v.shows}});
    fmt::print("{}\n", array.dump(2));
    return 0;
  }
  fmt::print("{:<18} {:<16} {}\n", "view", "angles", "shows");
  for (const StandardView& v : standard_views())
    fmt::print("{:<18} {:<16} {}\n", v.name, angles_text(v.lao_deg, v.cran_deg), v.shows);
  return 0;
}

}  // namespace ostium
