#include "app/commands/treat/room.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/angiography/settle.h"
#include "app/command_line/pictures.h"
#include "app/command_line/progress.h"
#include "fluoro/display/overlay.h"

namespace ostium::app {

std::string artery_of(const Plan& plan, const vascular::FlowTree& tree) {
  const vascular::Territory t = tree.branches[tree.branch(plan.lesion.branch)].territory;
  return vascular::territory_names[static_cast<int>(t)];
}

namespace {

std::string usual_view(const Plan& plan, const std::string& artery) {
  if (plan.lesion.branch == "LM") return "spider";
  return artery == "RCA" ? "lao" : artery == "LCx" ? "rao-caudal" : "lao-cranial";
}

}  // namespace

TreatmentRoom::TreatmentRoom(const data::Case& c, const TreatArguments& a)
    : arguments(a),
      views(c.views),
      patient(patient_of(c)),
      physiology(circulation_of(patient, c.name, a.seed)),
      scene(patient, physiology),
      plan(plan_treatment(patient, physiology.flow, a.seed,
                          {.stent = !a.no_stent,
                           .predilate = !a.no_predilatation,
                           .postdilate = !a.no_postdilatation,
                           .oversize = a.oversize,
                           .pressure = a.pressure,
                           .shift_m = 1e-3 * a.shift_mm})),
      bed{physiology,
          plan.model,
          at_rest(physiology, c.rate_1_min),
          make_state(plan.model, physiology.flow.tree),
          {},
          {},
          {},
          {},
          {},
          {}} {
  bed.inputs.heart.rate_1_min = c.rate_1_min;
}

fluoro::View TreatmentRoom::view_on(const Plan& p) const {
  const std::string artery = artery_of(p, physiology.flow.tree);
  const bool left = artery != "RCA";
  const std::string named = arguments.view.empty() ? usual_view(p, artery) : arguments.view;
  fluoro::View view = view_of(named_view(named, views), patient, left, arguments.pixels);
  view.field_m = 0.16;
  // Places what is treated well within the picture.
  const int cell = p.path.cells[p.path.at(p.middle_m).index];
  const Eigen::Vector3d to = scene.map().coronary.position(static_cast<std::size_t>(cell), 0.7) - view.arm.p_PI;
  constexpr double from_middle_m = 0.035;
  view.arm.p_PI += std::max(0.0, 1 - from_middle_m / to.norm()) * to;
  return view;
}

Bedside TreatmentRoom::opacified(Angiogram& angiogram, bool left) const {
  // Films a copy, so that the contrast injected for the film does not change the treatment.
  Bedside film = bed;
  film.each_step = nullptr;
  angiogram.wait_for(0.9, bed.inputs.heart.rate_1_min, film.blood);
  const Injection injection = usual_injection(physiology.flow.tree, left);
  vascular::ContrastInputs& contrast = film.inputs.contrast;
  contrast.tip = injection.tip, contrast.iodine_kg_m3 = injection.iodine_kg_m3;
  std::fill(film.blood.contrast.line_kg.begin(), film.blood.contrast.line_kg.end(),
            injection.iodine_kg_m3 * contrast.line.dead_m3 / vascular::line_cells);
  contrast.injection_m3_s = injection.rate_m3_s;
  for (int n = 0; n < 2000 || film.blood.heart.phase < 0.6 || film.blood.heart.phase > 0.75; ++n) film.step();
  return film;
}

fluoro::Picture TreatmentRoom::picture(const Plan& p, const std::string& words, bool with_contrast) {
  const fluoro::View view = view_on(p);
  Angiogram angiogram(physiology, scene, view, 15, arguments.seed + 1, renderer_named(arguments.renderer));
  const auto take = [&](const Bedside& now, bool wire) {
    scene.at(now.blood, now.inputs.occupied_m);
    add_devices(now, p, patient, scene, wire);
    return angiogram.take(now.blood.heart.phase);
  };
  fluoro::Picture out =
      with_contrast ? take(opacified(angiogram, artery_of(p, physiology.flow.tree) != "RCA"), false) : take(bed, true);
  draw_overlay({view, fluoro::cine(15), angiogram.report().frame.exposure, angiogram.fluoroscope().dose, true, words,
                arguments.of},
               out);
  return out;
}

nlohmann::ordered_json TreatmentRoom::lesion(const Plan& p) {
  const LesionNumbers n = measure(p, physiology.flow, bed.state.wall);
  const std::string artery = artery_of(p, physiology.flow.tree);
  nlohmann::ordered_json out = {{"mld_mm", n.mld_mm},
                                {"reference_mm", n.reference_mm},
                                {"stenosis_percent", n.stenosis_percent},
                                {"ffr_model", n.ffr}};
  if (arguments.no_pictures) return out;
  show_progress("counting frames of " + artery);
  vascular::PhysiologyState rest = bed.blood;
  const TimiCount count = timi_count(physiology, scene, patient, artery, rest, bed.inputs.heart.rate_1_min, 0.9);
  out["timi_frame_count"] = count.reached ? nlohmann::ordered_json(count.frames) : nlohmann::ordered_json(nullptr);
  return out;
}

}  // namespace ostium::app
