#include "app/treat_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/angiography/devices.h"
#include "app/angiography/settle.h"
#include "data/formats/load_error.h"
#include "data/formats/png.h"
#include "fluoro/overlay.h"
#include "fluoro/views.h"
#include "vascular/units.h"

namespace ostium {

namespace {

using json = nlohmann::ordered_json;

void say(const std::string& what) {
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "{:<78}\r", what);
}

std::string artery_of(const Plan& plan, const FlowTree& tree) {
  const Territory t = tree.branches[tree.branch(plan.lesion.branch)].territory;
  return territory_names[static_cast<int>(t)];
}

std::string usual_view(const Plan& plan, const std::string& artery) {
  if (plan.lesion.branch == "LM") return "spider";
  return artery == "RCA" ? "lao" : artery == "LCx" ? "rao-caudal" : "lao-cranial";
}

constexpr double before_s = 2, recovers_s = 10;  // of the strips, beside the inflation

/// A lead's strip, as high as the lead needs.
Strip strip_of(Lead lead) {
  constexpr std::pair<float, float> range[leads] = {{-0.3F, 1.15F}, {-0.3F, 0.8F}, {-0.3F, 0.9F},
                                                    {-0.4F, 0.6F},  {-1.1F, 0.8F}, {-0.4F, 1.5F}};
  const auto [low, high] = range[static_cast<int>(lead)];
  return {lead_names[static_cast<int>(lead)], "mV", 250, {}, low, high};
}

/// Two that tell of the territory.
std::array<Lead, 2> telling_leads(const std::string& artery) {
  if (artery == "RCA") return {Lead::III, Lead::aVL};
  if (artery == "LCx") return {Lead::V5, Lead::V2};
  return {Lead::II, Lead::V2};
}

/// ECG and pressure, 250 a second, as the monitor beside the pictures shows them.
struct Monitor {
  std::array<Lead, 2> which;
  std::vector<Strip> strips;  ///< two leads, aorta, gauge
  long step = 0;

  explicit Monitor(const std::string& artery) : which(telling_leads(artery)) {
    for (Lead lead : which) strips.push_back(strip_of(lead));
    strips.push_back({"Ao", "mmHg", 250, {}, 50, 130});
    strips.push_back({"gauge", "atm", 250, {}, -2, 22});
  }
  double seconds() const { return static_cast<double>(strips[0].samples.size()) / 250; }
  /// Keeps no more than so many seconds from the beginning.
  void end(double seconds) {
    for (Strip& strip : strips)
      strip.samples.resize(std::min(strip.samples.size(), static_cast<std::size_t>(seconds * strip.samples_per_s)));
  }
  void listen(const Bedside& bed) {
    if (step++ % 4) return;
    const auto leads = ecg(bed.blood.heart, bed.inputs.heart.rate_1_min, bed.physiology.ischaemia, bed.blood.ischaemia);
    for (int k = 0; k < 2; ++k) strips[k].samples.push_back(static_cast<float>(leads[static_cast<int>(which[k])]));
    const Pressures p = pressures(bed.physiology.heart, bed.blood.heart);
    strips[2].samples.push_back(static_cast<float>(p.aorta_Pa / mmHg));
    strips[3].samples.push_back(static_cast<float>(bed.device.gauge_Pa / atm));
  }
};

/// One patient on the table.
class Room {
 public:
  Room(const Case& c, const TreatOptions& o)
      : options(o),
        patient(patient_of(c)),
        physiology(make_physiology(patient, o.seed)),
        scene(patient, physiology),
        plan(plan_treatment(patient, physiology.flow, o.seed,
                            {.stent = !o.no_stent,
                             .predilate = !o.no_predilatation,
                             .postdilate = !o.no_postdilatation,
                             .oversize = o.oversize,
                             .pressure = o.pressure,
                             .shift_m = 1e-3 * o.shift_mm})),
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

  Picture picture(const Plan& p, const std::string& words, bool with_contrast) {
    const std::string artery = artery_of(p, physiology.flow.tree);
    const bool left = artery != "RCA";
    View view = view_of(options.view.empty() ? usual_view(p, artery) : options.view, patient, left, options.pixels);
    view.field_m = 0.16;
    // What is treated is well within the picture.
    const int cell = p.path.cells[p.path.at(p.middle_m).index];
    const Eigen::Vector3d to = scene.map().coronary.position(static_cast<std::size_t>(cell), 0.7) - view.arm.p_PI;
    constexpr double from_middle_m = 0.035;
    view.arm.p_PI += std::max(0.0, 1 - from_middle_m / to.norm()) * to;

    Angiogram angiogram(physiology, scene, view, 15, options.seed + 1);
    Picture out;
    if (with_contrast) {
      // Filmed on a copy: a film changes nothing but the contrast that it needs.
      Bedside film = bed;
      film.each_step = nullptr;
      angiogram.wait_for(0.9, bed.inputs.heart.rate_1_min, film.blood);
      const Injection injection = usual_injection(physiology.flow.tree, left);
      ContrastInputs& contrast = film.inputs.contrast;
      contrast.tip = injection.tip, contrast.iodine_kg_m3 = injection.iodine_kg_m3;
      std::fill(film.blood.contrast.line_kg.begin(), film.blood.contrast.line_kg.end(),
                injection.iodine_kg_m3 * contrast.line.dead_m3 / line_cells);
      contrast.injection_m3_s = injection.rate_m3_s;
      for (int n = 0; n < 2000 || film.blood.heart.phase < 0.6 || film.blood.heart.phase > 0.75; ++n) film.step();
      scene.at(film.blood, film.inputs.occupied_m);
      add_devices(film, p, patient, scene, false);
      out = angiogram.take(film.blood.heart.phase);
    } else {
      scene.at(bed.blood, bed.inputs.occupied_m);
      add_devices(bed, p, patient, scene, true);
      out = angiogram.take(bed.blood.heart.phase);
    }
    draw_overlay(
        {view, cine(15), angiogram.report().frame.exposure, angiogram.fluoroscope().dose, true, words, c_name()}, out);
    return out;
  }

  json lesion(const Plan& p) {
    const LesionNumbers n = measure(p, physiology.flow, bed.state.wall);
    const std::string artery = artery_of(p, physiology.flow.tree);
    json out = {{"mld_mm", n.mld_mm},
                {"reference_mm", n.reference_mm},
                {"stenosis_percent", n.stenosis_percent},
                {"ffr_model", n.ffr}};
    if (options.no_pictures) return out;
    say("counting frames of " + artery);
    PhysiologyState rest = bed.blood;
    const TimiCount count = timi_count(physiology, scene, patient, artery, rest, bed.inputs.heart.rate_1_min, 0.9);
    out["timi_frame_count"] = count.reached ? json(count.frames) : json(nullptr);
    return out;
  }

  std::string c_name() const { return options.of; }

  const TreatOptions& options;
  Patient patient;
  PhysiologyModel physiology;
  PatientScene scene;
  Treatable plan;
  Bedside bed;
};

json inflation_json(const InflationRecord& r) {
  return {{"device", r.device},
          {"gauge_atm", r.gauge_Pa / atm},
          {"diameter_mm", 1e3 * r.diameter_m},
          {"balloon_artery_ratio", r.largest_over_reference},
          {"waist_at_4_atm", r.waist_at_4_atm},
          {"waist_gave_at_atm", r.waist_gave_Pa > 0 ? json(r.waist_gave_Pa / atm) : json(nullptr)},
          {"slip_mm", 1e3 * r.slip_m},
          {"deflated_after_s", r.deflated_s},
          {"ST_shift_mV", r.ST_mV},
          {"burst", r.burst}};
}

json stent_json(const StentNumbers& s) {
  return {{"minimal_diameter_mm", s.minimal_diameter_mm},
          {"minimal_area_mm2", s.minimal_area_mm2},
          {"expansion_percent", s.expansion_percent},
          {"apposed_percent", s.apposed_percent},
          {"worst_gap_mm", s.worst_gap_mm},
          {"recoil_percent", s.recoil_percent},
          {"foreshortening_percent", s.foreshortening_percent},
          {"stent_margin_proximal_mm", s.margin_proximal_mm},
          {"stent_margin_distal_mm", s.margin_distal_mm},
          {"lesion_coverage_percent", s.coverage_percent}};
}

void print_table(const json& report) {
  for (const json& lesion : report["lesions"]) {
    fmt::print("{}\n  {:<28} {:>9} {:>9}\n", lesion["place"].get<std::string>(), "", "before", "after");
    for (const auto& [key, value] : lesion["before"].items()) {
      const json& after = lesion["after"][key];
      const auto number = [](const json& n) { return n.is_number() ? fmt::format("{:.2f}", n.get<double>()) : "none"; };
      fmt::print("  {:<28} {:>9} {:>9}\n", key, number(value), number(after));
    }
    if (lesion.contains("stent"))
      for (const auto& [key, value] : lesion["stent"].items())
        fmt::print("  {:<28} {:>9} {:>9.2f}\n", key, "", value.get<double>());
    for (const json& i : lesion["inflations"])
      fmt::print("  {:<38} {:4.0f} atm, {:.2f} mm, ratio {:.2f}, waist at 4 atm {:.2f}{}{}\n",
                 i["device"].get<std::string>(), i["gauge_atm"].get<double>(), i["diameter_mm"].get<double>(),
                 i["balloon_artery_ratio"].get<double>(), i["waist_at_4_atm"].get<double>(),
                 std::fabs(i["slip_mm"].get<double>()) > 0.5 ? ", slipped" : "",
                 i["burst"].get<bool>() ? ", BURST" : "");
  }
  for (const json& injury : report["injuries"])
    fmt::print("injury: {} {} in {}\n", injury["kind"].get<std::string>(), injury["grade"].get<std::string>(),
               injury["branch"].get<std::string>());
  if (report.contains("file")) fmt::print("{}\n", report["file"].get<std::string>());
}

}  // namespace

int treat_command(const TreatOptions& o) {
  if (!o.out.ends_with(".png")) throw LoadError(o.out + ": what is it to be? .png is known");
  if (!o.view.empty() && !find_view(o.view))
    throw LoadError("there is no view \"" + o.view + "\"; `ostium views` lists them");
  for (const auto& [name, value] : {std::pair{"--hold", o.hold_s}, std::pair{"--pressure", o.pressure},
                                    std::pair{"--oversize", o.oversize}, std::pair{"--shift", o.shift_mm}})
    if (!std::isfinite(value)) throw LoadError(std::string(name) + " is not a number");
  const Case c = find_case(o.of);
  say("building " + c.name);
  Room room(c, o);
  Bedside& bed = room.bed;
  // As an operator begins: blood thinned, arteries wide.
  bed.device.doses = {.heparin_U = 100 * room.plan.model.drugs.weight_kg, .nitrate_ug = 200};
  bed.step();
  bed.device.doses = {};
  for (int n = 0; n < 20000; ++n) bed.step();
  json report = {{"case", c.name}, {"seed", o.seed}, {"act_s", act_s(room.plan.model.drugs, bed.state.drugs)}};
  report["lesions"] = json::array();
  std::vector<Picture> sheets;
  for (Plan& plan : room.plan.plans) {
    json lesion = {{"place", fmt::format("{}, {:.0f} to {:.0f} mm", plan.lesion.branch, 1e3 * plan.lesion.from_m,
                                         1e3 * (plan.lesion.from_m + plan.lesion.length_m))}};
    lesion["before"] = room.lesion(plan);
    Picture before, inflating, after;
    if (!o.no_pictures) before = room.picture(plan, "BEFORE", true);
    const std::string artery = artery_of(plan, room.physiology.flow.tree);
    Monitor monitor(artery), kept(artery);
    std::vector<InflationRecord> records;
    for (const auto& [balloon, gauge] : inflations_of(plan)) {
      say(fmt::format("{} at {:.0f} atm", room.plan.model.balloons[balloon].name, gauge / atm));
      bool filmed = o.no_pictures || !inflating.grey.empty();
      monitor = Monitor(artery);
      bed.each_step = [&](const Bedside& now) {
        monitor.listen(now);
        // While the waist still stands, in mid-diastole.
        if (!filmed && now.state.balloon.pressure_Pa > 3.5 * atm && std::fabs(now.blood.heart.phase - 0.7) < 0.02) {
          filmed = true;
          inflating = room.picture(plan, fmt::format("{:.1f} ATM", now.state.balloon.pressure_Pa / atm), false);
        }
      };
      bed.device.balloon = -1;
      for (int n = 0; n < 1000 * before_s; ++n) bed.step();
      records.push_back(inflate(bed, plan, balloon, gauge, o.hold_s));
      monitor.end(before_s + gauge / (2 * atm) + o.hold_s + recovers_s);
      kept = monitor;
      const int stent = room.plan.model.stent_on[balloon];
      if (stent >= 0 && bed.state.stents[stent].where == StentState::deployed && !is_tied(bed.state.stents[stent]))
        tie_to_wall(room.plan.model.stents[stent], room.patient, room.scene.shape(), room.scene.map(), plan.path,
                    bed.state.wall, bed.blood.heart.phase, bed.state.stents[stent]);
    }
    bed.each_step = nullptr;
    bed.device.balloon = -1;
    say("blood flows as at rest again");
    for (int n = 0; n < 60000; ++n) bed.step();
    // Postdilatation moved the wall: the stent's points with it.
    if (plan.stent >= 0)
      if (const int i = room.plan.model.stent_on[plan.stent]; bed.state.stents[i].where == StentState::deployed) {
        tie_to_wall(room.plan.model.stents[i], room.patient, room.scene.shape(), room.scene.map(), plan.path,
                    bed.state.wall, bed.blood.heart.phase, bed.state.stents[i]);
        lesion["stent"] = stent_json(measure(plan, room.plan.model.stents[i], bed.state.stents[i], bed.state.wall));
      }
    lesion["after"] = room.lesion(plan);
    lesion["inflations"] = json::array();
    for (const InflationRecord& r : records) lesion["inflations"].push_back(inflation_json(r));
    report["lesions"].push_back(lesion);
    if (o.no_pictures) continue;
    after = room.picture(plan, "AFTER", true);
    Picture sheet = beside(beside(before, inflating), after);
    append_strips(kept.strips, kept.seconds(), o.pixels * 7 / 10, sheet);
    sheets.push_back(sheet);
  }
  report["injuries"] = json::array();
  for (const Injury& injury : bed.state.injury.injuries)
    if (injury.cell >= 0)
      report["injuries"].push_back(
          {{"kind", injury.kind == InjuryKind::dissection ? "dissection" : "perforation"},
           {"grade", grade_name(injury)},
           {"branch", room.physiology.flow.tree
                          .branches[room.physiology.flow.tree.cells[static_cast<std::size_t>(injury.cell)].branch]
                          .name},
           {"outside_mL", injury.outside_m3 / mL}});
  if (!sheets.empty()) {
    Picture all = sheets.front();
    for (std::size_t i = 1; i < sheets.size(); ++i) {
      all.height += sheets[i].height;
      all.grey.insert(all.grey.end(), sheets[i].grey.begin(), sheets[i].grey.end());
    }
    write_png(o.out, all);
    report["file"] = o.out;
  }
  say("");
  if (o.json)
    fmt::print("{}\n", report.dump(2));
  else
    print_table(report);
  return 0;
}

}  // namespace ostium
