#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/patient_options.h"
#include "app/command_line/pictures.h"
#include "app/command_line/progress.h"
#include "app/commands/treat/report.h"
#include "app/commands/treat/room.h"
#include "app/commands/treat/strips.h"
#include "core/base/units.h"
#include "data/formats/png.h"
#include "vascular/treatment/stent_ties.h"

namespace ostium::app {

namespace {

using units::atm;

using json = nlohmann::ordered_json;

void declare(Options& options, TreatArguments& a) {
  add_case_option(options, a.of);
  add_patient_option(options, a.set);
  options.add("--hold", a.hold_s, "Seconds of each inflation").range(0.0, 600.0).show_default();
  options.add("--pressure", a.pressure, "Of what is usual").range(0.1, 3.0).show_default();
  options.add("--oversize", a.oversize, "Of every device's diameter").range(0.5, 2.0).show_default();
  options.add("--shift", a.shift_mm, "Devices lie so far beside the lesion, distally, mm").range(-30.0, 30.0);
  options.flag("--no-stent", a.no_stent, "Balloons alone");
  options.flag("--no-predilatation", a.no_predilatation, "The stent at once");
  options.flag("--no-postdilatation", a.no_postdilatation, "The stent's own balloon is the last");
  options.flag("--no-pictures", a.no_pictures, "Numbers alone, without frame counts");
  add_view_option(options, a.view);
  add_pixels_option(options, a.pixels, 256);
  add_renderer_option(options, a.renderer);
  options.add("--seed", a.seed, "Of what happens by chance").show_default();
  add_json_flag(options, a.json);
  options.add("-o,--out", a.out, "FILE.png: before, while inflating, after, and the strips").show_default().writes();
  options.exclude("--no-pictures", {"--out", "--view", "--pixels", "--renderer"});
}

constexpr double before_s = 2, recovers_s = 10;  // shown before and after the inflation

void step(TreatmentRoom& room, double seconds) {
  for (int n = 0; n < 1000 * seconds; ++n) room.bed.step();
}

/// The usual preparation: anticoagulation and vasodilatation.
void prepare(TreatmentRoom& room) {
  room.bed.device.doses = {.heparin_U = 100 * room.plan.model.drugs.weight_kg, .nitrate_ug = 200};
  room.bed.step();
  room.bed.device.doses = {};
  step(room, 20);
}

void tie(TreatmentRoom& room, const Plan& plan, int stent) {
  const vascular::StentTies ties(room.patient, room.scene.shape(), room.scene.map(), room.physiology.flow.tree);
  tie_to_wall(ties, room.plan.model.stents[stent], plan.path, room.bed.state.wall,
              {.phase = room.bed.blood.heart.phase}, room.bed.state.stents[stent]);
}

bool is_deployed(const TreatmentRoom& room, int stent) {
  return stent >= 0 && room.bed.state.stents[stent].where == vascular::StentState::deployed;
}

struct Inflated {
  InflationRecord record;
  InflationStrips strips;
};

/// `inflating`: set to the picture with the waist still visible, in mid-diastole; kept if already set.
Inflated inflate_one(TreatmentRoom& room, const Plan& plan, const PlannedInflation& planned,
                     fluoro::Picture& inflating) {
  const TreatArguments& a = room.arguments;
  Bedside& bed = room.bed;
  const auto& [balloon, gauge] = planned;
  show_progress(fmt::format("{} at {:.0f} atm", room.plan.model.balloons[balloon].name, gauge / atm));
  InflationStrips strips(artery_of(plan, room.physiology.flow.tree));
  bool filmed = a.no_pictures || !inflating.grey.empty();
  bed.each_step = [&](const Bedside& now) {
    strips.listen(now);
    if (!filmed && now.state.balloons[0].pressure_Pa > 3.5 * atm && std::fabs(now.blood.heart.phase - 0.7) < 0.02) {
      filmed = true;
      inflating = room.picture(plan, fmt::format("{:.1f} ATM", now.state.balloons[0].pressure_Pa / atm), false);
    }
  };
  bed.device.balloons[0].balloon = -1;
  step(room, before_s);
  const InflationRecord record = inflate(bed, plan, balloon, gauge, a.hold_s);
  bed.each_step = nullptr;
  strips.end(before_s + gauge / (2 * atm) + a.hold_s + recovers_s);
  if (const int stent = room.plan.model.stent_on[balloon];
      is_deployed(room, stent) && !is_tied(bed.state.stents[stent]))
    tie(room, plan, stent);
  return {record, strips};
}

/// Treats one lesion and reports before and after; appends its sheet of pictures to `sheets`.
json treat_lesion(TreatmentRoom& room, const Plan& plan, std::vector<fluoro::Picture>& sheets) {
  const TreatArguments& a = room.arguments;
  Bedside& bed = room.bed;
  json lesion = {{"place", fmt::format("{}, {:.0f} to {:.0f} mm", plan.lesion.branch, 1e3 * plan.lesion.from_m,
                                       1e3 * (plan.lesion.from_m + plan.lesion.length_m))}};
  lesion["before"] = room.lesion(plan);
  fluoro::Picture before, inflating;
  if (!a.no_pictures) before = room.picture(plan, "BEFORE", true);
  InflationStrips kept(artery_of(plan, room.physiology.flow.tree));
  json inflations = json::array();
  for (const PlannedInflation& planned : inflations_of(plan)) {
    const Inflated inflated = inflate_one(room, plan, planned, inflating);
    inflations.push_back(to_json(inflated.record));
    kept = inflated.strips;
  }
  bed.device.balloons[0].balloon = -1;
  show_progress("blood flows as at rest again");
  step(room, 60);
  // Postdilatation moved the wall, so the stent's points are moved with it.
  if (const int stent = plan.stent >= 0 ? room.plan.model.stent_on[plan.stent] : -1; is_deployed(room, stent)) {
    tie(room, plan, stent);
    lesion["stent"] = to_json(measure(plan, room.plan.model.stents[stent], bed.state.stents[stent], bed.state.wall));
  }
  lesion["after"] = room.lesion(plan);
  lesion["inflations"] = inflations;
  if (a.no_pictures) return lesion;
  fluoro::Picture sheet = beside(beside(before, inflating), room.picture(plan, "AFTER", true));
  append_strips(kept.strips, kept.seconds(), a.pixels * 7 / 10, sheet);
  sheets.push_back(sheet);
  return lesion;
}

int run(const TreatArguments& a) {
  require_ending(a.out, {".png"});
  const data::Case c = case_with(a.of, a.set);
  if (!a.view.empty()) named_view(a.view, c.views);
  show_progress("building " + c.name);
  TreatmentRoom room(c, a);
  prepare(room);
  json report = {{"case", c.name}, {"seed", a.seed}, {"act_s", act_s(room.plan.model.drugs, room.bed.state.drugs)}};
  report["lesions"] = json::array();
  std::vector<fluoro::Picture> sheets;
  for (const Plan& plan : room.plan.plans) report["lesions"].push_back(treat_lesion(room, plan, sheets));
  report["injuries"] = to_json(room.bed.state.injury, room.physiology.flow.tree);
  if (!sheets.empty()) {
    fluoro::Picture all = sheets.front();
    for (std::size_t i = 1; i < sheets.size(); ++i) all = stacked(std::move(all), sheets[i]);
    data::write_png(a.out, all);
    report["file"] = a.out;
  }
  show_progress("");
  if (a.json)
    fmt::print("{}\n", report.dump(2));
  else
    print_treatment(report);
  return 0;
}

}  // namespace

Command treat_command() {
  return make_command("treat",
                      "A case's lesions treated by the book, devices on the centreline: numbers, pictures, strips",
                      {"ostium treat rca-mid-focal -o rca.png",
                       "ostium treat lad-proximal-eccentric --oversize 1.3 --seed 4 --no-pictures",
                       "ostium treat rca-diffuse --json > rca-diffuse.json"},
                      declare, run);
}

}  // namespace ostium::app
