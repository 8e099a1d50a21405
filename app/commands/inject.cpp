#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/angiography/angiogram.h"
#include "app/angiography/settle.h"
#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/interrupt.h"
#include "app/command_line/patient_options.h"
#include "app/command_line/pictures.h"
#include "app/command_line/progress.h"
#include "core/base/units.h"
#include "data/formats/load_error.h"
#include "data/formats/png.h"
#include "data/formats/video.h"
#include "fluoro/display/overlay.h"
#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::app {

namespace {

using units::mL;

struct Arguments {
  std::string of = "rca-mid-focal";  ///< case
  std::vector<std::string> set;      ///< which person
  std::string at = "right";          ///< left, right: the ostium; left-sinus, right-sinus, aorta
  std::optional<double> rate_mL_s;   ///< usual: as measured for hand injection, 2.1 left and 1.7 right
  std::optional<double> volume_mL;   ///< usual: 7.1 left, 4.8 right
  double iodine_mg_mL = 350;
  double phase = 0.9;  ///< cardiac phase when contrast reaches the tip
  double seconds = 5;
  double frames_per_s = 15;
  std::string view;  ///< "": lao for the right coronary, rao-cranial for the left
  int pixels = 512;
  bool healthy = false;  ///< without lesions
  bool plain = false;    ///< no text on the pictures
  bool count = false, json = false;
  std::uint64_t seed = 1;
  std::string renderer = "scanline";
  std::string out = "inject.png";  ///< .png: several moments side by side; .mp4: a film

  bool left() const { return at.starts_with("left") || at == "aorta"; }
};

void declare(Options& options, Arguments& a) {
  add_case_option(options, a.of);
  add_patient_option(options, a.set);
  options.add("--at", a.at, "Where the catheter's tip is")
      .one_of({"left", "right", "left-sinus", "right-sinus", "aorta"})
      .show_default();
  options.add("--rate", a.rate_mL_s, "mL/s; as injected by hand if not given: 2.1 left, 1.7 right").range(0.01, 30.0);
  options.add("--volume", a.volume_mL, "mL; 7.1 left, 4.8 right").range(0.01, 100.0);
  options.add("--iodine", a.iodine_mg_mL, "mg/mL in the syringe").range(0.0, 400.0).show_default();
  options.add("--phase", a.phase, "Of the heart as it begins; 0 is the R wave").range(0.0, 1.0).show_default();
  options.add("--seconds", a.seconds, "Length of the run").range(0.2, 60.0).show_default();
  add_frame_rate_option(options, "--rate-fps", a.frames_per_s);
  add_view_option(options, a.view);
  add_pixels_option(options, a.pixels, 256);
  add_renderer_option(options, a.renderer);
  options.flag("--healthy", a.healthy, "The same person without lesions");
  options.flag("--plain", a.plain, "No text on the pictures");
  options.flag("--count", a.count, "TIMI frame counts too (30 frames/s, a run for each artery)");
  options.add("--seed", a.seed, "Of noise and chance").show_default();
  add_json_flag(options, a.json);
  options.add("-o,--out", a.out, "FILE.mp4, or FILE.png: six moments").show_default().writes();
}

Injection injection_of(const Arguments& a, const vascular::PhysiologyModel& model) {
  const bool left = a.at.starts_with("left");
  Injection injection = usual_injection(model.flow.tree, left);
  if (a.at == "left-sinus" || a.at == "right-sinus")
    injection.tip = {left ? vascular::TipPlace::left_sinus : vascular::TipPlace::right_sinus, 0, 0.3};
  if (a.at == "aorta") injection.tip = {vascular::TipPlace::aorta, model.contrast.ostium_cell[0] + 2, 0};
  if (a.rate_mL_s) injection.rate_m3_s = *a.rate_mL_s * mL;
  if (a.volume_mL) injection.volume_m3 = *a.volume_mL * mL;
  injection.iodine_kg_m3 = a.iodine_mg_mL;
  return injection;
}

constexpr int moments = 6;  ///< of a sheet

/// They stand in two rows of three.
fluoro::Picture sheet_of(const std::vector<fluoro::Picture>& kept) {
  const auto row = [&](std::size_t from) { return beside(beside(kept[from], kept[from + 1]), kept[from + 2]); };
  return stacked(row(0), row(3));
}

/// Iodine balance. `before_kg` was in the body before, `in_line_kg` is in the catheter.
nlohmann::ordered_json balance(const data::Case& c, const vascular::ContrastState& s, double before_kg,
                               double in_line_kg) {
  const double off = (accounted_kg(s) - before_kg - in_line_kg - s.injected_kg) / (s.injected_kg + in_line_kg);
  return {{"case", c.name},
          {"injected_mL", s.injected_m3 / mL},
          {"iodine_g", 1e3 * s.injected_kg},
          {"through_muscle_g", 1e3 * (s.muscle_kg[0] + s.muscle_kg[1])},
          {"down_aorta_g", 1e3 * s.carried_kg},
          {"iodine_balance", off}};
}

int run(const Arguments& a) {
  const bool video = vascular::ending_of(a.out) == ".mp4";
  require_ending(a.out, {".png", ".mp4"});
  fluoro::require_rate(a.frames_per_s);
  const int frames = static_cast<int>(std::lround(a.seconds * a.frames_per_s));
  if (!video && frames < moments)
    throw data::LoadError(
        fmt::format("{} s at {} frames/s are {} pictures, and {} shows {} moments; expected {:g} s at "
                    "least, or a film (.mp4)",
                    a.seconds, a.frames_per_s, frames, a.out, moments, moments / a.frames_per_s));
  data::Case c = case_with(a.of, a.set);
  const fluoro::StandardView named = named_view(!a.view.empty() ? a.view : a.left() ? "rao-cranial" : "lao", c.views);
  if (a.healthy) c.lesions.clear();
  show_progress("building " + c.name);
  const vascular::Patient patient = patient_of(c);
  const vascular::PhysiologyModel model = circulation_of(patient, c.name, a.seed);
  PatientScene scene(patient, model);
  show_progress("the heart beats until blood flows as it does at rest");
  vascular::PhysiologyState state = at_rest(model, c.rate_1_min);
  const vascular::PhysiologyState rest = state;
  const fluoro::View view = app::view_of(named, patient, a.left(), a.pixels);
  require_reachable(view.arm);
  Angiogram angiogram(model, scene, view, a.frames_per_s, a.seed, renderer_named(a.renderer));
  angiogram.wait_for(a.phase, c.rate_1_min, state);
  const double before_kg = accounted_kg(state.contrast);
  const Injection injection = injection_of(a, model);
  vascular::PhysiologyInputs inputs;
  inputs.heart.rate_1_min = c.rate_1_min;
  std::optional<data::VideoWriter> writer;
  if (video) writer.emplace(a.out, a.pixels, a.pixels, a.frames_per_s);
  std::vector<fluoro::Picture> kept;
  double in_line_kg = 0;
  if (video) stop_on_signals();  // a film ends with the frames that it has
  for (int n = 0; n < frames && !interrupted; ++n) {
    fluoro::Picture picture = angiogram.frame(injection, inputs, state);
    if (n == 0) in_line_kg = injection.iodine_kg_m3 * inputs.contrast.line.dead_m3;
    if (!a.plain)
      draw_overlay({view, fluoro::cine(a.frames_per_s), angiogram.report().frame.exposure, angiogram.fluoroscope().dose,
                    true, "", c.name},
                   picture);
    if (writer) writer->add(picture);
    if (n * moments / frames != (n - 1) * moments / frames || n == 0) kept.push_back(picture);
    show_progress(fmt::format("frame {} of {}", n + 1, frames));
  }
  show_progress("");
  if (!finish_film(writer, "inject")) return 1;
  if (!video) data::write_png(a.out, sheet_of(kept));
  nlohmann::ordered_json numbers = balance(c, state.contrast, before_kg, in_line_kg);
  if (a.count && !interrupted)
    for (const char* artery : {"LAD", "LCx", "RCA"}) {
      show_progress(fmt::format("frame count of {}", artery));
      const TimiCount count = timi_count(model, scene, patient, artery, rest, c.rate_1_min, a.phase);
      numbers[fmt::format("timi_frame_count_{}", artery)] = count.reached ? nlohmann::json(count.frames) : nullptr;
    }
  numbers["file"] = a.out;
  show_progress("");
  if (a.json)
    fmt::print("{}\n", numbers.dump(2));
  else
    for (const auto& [key, value] : numbers.items()) fmt::print("{:<22} {}\n", key, value.dump());
  return 0;
}

}  // namespace

Command inject_command() {
  return make_command("inject", "Contrast into a case's arteries, filmed; frame counts, balance",
                      {"ostium inject rca-mid-focal --rate 3 --volume 6 -o run.mp4",
                       "ostium inject lad-proximal-eccentric --at left --view spider -o spider.png",
                       "ostium inject rca-mid-focal --healthy --count --json"},
                      declare, run);
}

}  // namespace ostium::app
