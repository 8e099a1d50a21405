#include "app/inject_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/angiography/angiogram.h"
#include "app/angiography/settle.h"
#include "data/formats/load_error.h"
#include "data/formats/png.h"
#include "data/formats/video.h"
#include "fluoro/overlay.h"
#include "vascular/units.h"

namespace ostium {

namespace {

void say(const std::string& what) {
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "{:<78}\r", what);
}

Injection injection_of(const InjectOptions& o, const PhysiologyModel& model) {
  const bool left = o.at.starts_with("left");
  Injection injection = usual_injection(model.flow.tree, left);
  if (o.at == "left-sinus" || o.at == "right-sinus")
    injection.tip = {left ? TipPlace::left_sinus : TipPlace::right_sinus, 0, 0.3};
  if (o.at == "aorta") injection.tip = {TipPlace::aorta, model.contrast.ostium_cell[0] + 2, 0};
  if (o.rate_mL_s > 0) injection.rate_m3_s = o.rate_mL_s * mL;
  if (o.volume_mL > 0) injection.volume_m3 = o.volume_mL * mL;
  injection.iodine_kg_m3 = o.iodine_mg_mL;
  return injection;
}

}  // namespace

int inject_command(const InjectOptions& o) {
  const bool video = o.out.ends_with(".mp4");
  if (!video && !o.out.ends_with(".png")) throw LoadError(o.out + ": what is it to be? .png and .mp4 are known");
  require_rate(o.frames_per_s);
  for (const auto& [name, value] : {std::pair{"--rate", o.rate_mL_s}, std::pair{"--volume", o.volume_mL},
                                    std::pair{"--iodine", o.iodine_mg_mL}, std::pair{"--phase", o.phase}})
    if (!std::isfinite(value)) throw LoadError(std::string(name) + " is not a number");
  Case c = find_case(o.of);
  if (o.healthy) c.lesions.clear();
  const bool left = o.at.starts_with("left") || o.at == "aorta";
  say("building " + c.name);
  const Patient patient = patient_of(c);
  const PhysiologyModel model = make_physiology(patient, o.seed);
  PatientScene scene(patient, model);
  say("the heart beats until blood flows as it does at rest");
  PhysiologyState state = at_rest(model, c.rate_1_min);
  const PhysiologyState rest = state;
  const View view = view_of(!o.view.empty() ? o.view : left ? "rao-cranial" : "lao", patient, left, o.pixels);
  require_reachable(view.arm);
  Angiogram angiogram(model, scene, view, o.frames_per_s, o.seed);
  angiogram.wait_for(o.phase, c.rate_1_min, state);
  const double before_kg = accounted_kg(state.contrast);
  const Injection injection = injection_of(o, model);
  PhysiologyInputs inputs;
  inputs.heart.rate_1_min = c.rate_1_min;
  std::optional<VideoWriter> writer;
  if (video) writer.emplace(o.out, o.pixels, o.pixels, o.frames_per_s);
  const int frames = static_cast<int>(std::lround(o.seconds * o.frames_per_s));
  std::vector<Picture> kept;
  double in_line_kg = 0;
  for (int n = 0; n < frames; ++n) {
    Picture picture = angiogram.frame(injection, inputs, state);
    if (n == 0) in_line_kg = injection.iodine_kg_m3 * inputs.contrast.line.dead_m3;
    draw_overlay(
        {view, cine(o.frames_per_s), angiogram.report().frame.exposure, angiogram.fluoroscope().dose, true, "", c.name},
        picture);
    if (writer) writer->add(picture);
    if (n * 6 / frames != (n - 1) * 6 / frames || n == 0) kept.push_back(picture);
    say(fmt::format("frame {} of {}", n + 1, frames));
  }
  say("");
  if (writer && !writer->finish()) {
    fmt::print(stderr, "ostium inject: {}\n", writer->problem());
    return 1;
  }
  if (!video) {
    const auto row = [&](std::size_t from) { return beside(beside(kept[from], kept[from + 1]), kept[from + 2]); };
    Picture sheet = row(0);
    const Picture below = row(3);
    sheet.height += below.height;
    sheet.grey.insert(sheet.grey.end(), below.grey.begin(), below.grey.end());
    write_png(o.out, sheet);
  }
  const ContrastState& s = state.contrast;
  const double off = (accounted_kg(s) - before_kg - in_line_kg - s.injected_kg) / (s.injected_kg + in_line_kg);
  nlohmann::ordered_json numbers = {{"case", c.name},
                                    {"injected_mL", s.injected_m3 / mL},
                                    {"iodine_g", 1e3 * s.injected_kg},
                                    {"through_muscle_g", 1e3 * s.muscle_kg},
                                    {"down_aorta_g", 1e3 * s.carried_kg},
                                    {"iodine_balance", off}};
  if (o.count)
    for (const char* artery : {"LAD", "LCx", "RCA"}) {
      say(fmt::format("frame count of {}", artery));
      const TimiCount count = timi_count(model, scene, patient, artery, rest, c.rate_1_min, o.phase);
      numbers[fmt::format("timi_frame_count_{}", artery)] = count.reached ? nlohmann::json(count.frames) : nullptr;
    }
  numbers["file"] = o.out;
  say("");
  if (o.json)
    fmt::print("{}\n", numbers.dump(2));
  else
    for (const auto& [key, value] : numbers.items()) fmt::print("{:<22} {}\n", key, value.dump());
  return 0;
}

}  // namespace ostium
