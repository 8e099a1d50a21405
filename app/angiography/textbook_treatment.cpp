#include "app/angiography/textbook_treatment.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace ostium::app {

namespace {

using units::atm;

using units::mm;
constexpr double reference_stretch = 5 * mm;

double quarter(double diameter_m) { return std::round(diameter_m / (0.25 * mm)) * 0.25 * mm; }

/// The shortest available length that suffices.
double sold_length(std::initializer_list<double> lengths_mm, double wanted_m) {
  for (double l : lengths_mm)
    if (l * mm >= wanted_m - 0.5 * mm) return l * mm;
  return *(lengths_mm.end() - 1) * mm;
}

double mean_diameter(const Plan& plan, const vascular::FlowTree& tree, const std::vector<double>& radius_m, double from,
                     double to) {
  double sum = 0, length = 0;
  for (std::size_t k = 0; k < plan.path.cells.size(); ++k) {
    const vascular::FlowCell& cell = tree.cells[plan.path.cells[k]];
    if (plan.path.s_m[k] < from || plan.path.s_m[k] > to) continue;
    sum += 2 * radius_m[plan.path.cells[k]] * cell.length_m, length += cell.length_m;
  }
  return length > 0 ? sum / length : 0;
}

std::vector<double> healthy_radii(const vascular::FlowTree& tree) {
  std::vector<double> radii;
  for (const vascular::FlowCell& cell : tree.cells) radii.push_back(cell.healthy_m);
  return radii;
}

/// The last branch along the continuation of a branch, for devices that reach beyond its end.
int far_branch(const vascular::FlowTree& tree, int branch) {
  int end = tree.branches[branch].last - 1;
  for (bool more = true; more;) {
    more = false;
    for (std::size_t b = 0; b < tree.branches.size(); ++b)
      if (tree.branches[b].parent_cell == end && tree.cells[tree.branches[b].first].healthy_m > 0.8e-3) {
        end = tree.branches[b].last - 1, branch = static_cast<int>(b), more = true;
        break;
      }
  }
  return branch;
}

}  // namespace

Treatable plan_treatment(const vascular::Patient& patient, const vascular::FlowModel& flow, std::uint64_t seed,
                         const PlanOptions& o) {
  const vascular::FlowTree& tree = flow.tree;
  Treatable out{.model = {.plaque = make_plaque_model(tree, patient.lesions),
                          .injury = {.seed = seed},
                          .drugs = {},
                          .balloons = {},
                          .stents = {},
                          .stent_on = {},
                          .paths = all_paths(tree)},
                .plans = {}};
  const std::vector<double> healthy = healthy_radii(tree);
  const auto add = [&](const vascular::BalloonModel& balloon, int stent) {
    out.model.balloons.push_back(balloon), out.model.stent_on.push_back(stent);
    out.model.balloons.back().seed = seed + out.model.balloons.size();
    return static_cast<int>(out.model.balloons.size()) - 1;
  };
  for (const vascular::Lesion& lesion : patient.lesions) {
    Plan plan{.lesion = lesion, .branch = far_branch(tree, tree.branch(lesion.branch)), .path = {}};
    plan.path = out.model.paths[plan.branch];
    plan.from_m = path_position(tree, plan.path, lesion.branch, lesion.from_m);
    plan.to_m = plan.from_m + lesion.length_m;
    plan.proximal_m = mean_diameter(plan, tree, healthy, plan.from_m - reference_stretch, plan.from_m);
    plan.distal_m = mean_diameter(plan, tree, healthy, plan.to_m, plan.to_m + reference_stretch);
    // Where the artery begins or ends there is one side only.
    if (plan.proximal_m == 0) plan.proximal_m = plan.distal_m;
    if (plan.distal_m == 0) plan.distal_m = plan.proximal_m;
    plan.reference_m = (plan.proximal_m + plan.distal_m) / 2;
    plan.middle_m = (plan.from_m + plan.to_m) / 2 + o.shift_m;
    const double hard = lesion.made_of.calcified() ? 1 : 0;
    if (o.predilate) {
      const double length = sold_length({10, 12, 15, 20, 30}, std::min(lesion.length_m, 20 * mm));
      plan.predilate =
          add(make_balloon(hard > 0 ? vascular::Compliance::non : vascular::Compliance::semi,
                           o.oversize * std::clamp(quarter(0.82 * plan.distal_m), 2 * mm, 3.5 * mm), length),
              -1);
      plan.predilate_Pa = o.pressure * (hard > 0 ? 16 : 10) * atm;
    }
    // A stent sized for the distal reference that still reaches 2 mm beyond the lesion after foreshortening; a strong
    // design in the left main.
    const double diameter = o.oversize * std::clamp(quarter(plan.distal_m), 2.25 * mm, 4.5 * mm);
    const double length = sold_length({8, 12, 15, 18, 23, 28, 33, 38}, lesion.length_m + 5 * mm);
    if (o.stent) {
      out.model.stents.push_back(vascular::make_stent(diameter, length));
      vascular::BalloonModel carrier = make_balloon(vascular::Compliance::semi, diameter, length + 0.5 * mm);
      carrier.nominal_Pa = 10 * atm, carrier.rated_Pa = 16 * atm, carrier.folded_m = 0.45 * mm;
      plan.stent = add(carrier, static_cast<int>(out.model.stents.size()) - 1);
      plan.stent_Pa = o.pressure * 12 * atm;
    }
    if (o.postdilate) {
      plan.postdilate = add(
          make_balloon(vascular::Compliance::non, o.oversize * std::clamp(quarter(plan.reference_m), 2.25 * mm, 5 * mm),
                       sold_length({8, 10, 12, 15, 20, 30}, length - 4 * mm)),
          -1);
      plan.postdilate_Pa = o.pressure * (hard > 0 ? 20 : 16) * atm;
    }
    // If the artery is wider proximally than that balloon: a second balloon for the stent's proximal end.
    if (const double wide = quarter(plan.proximal_m);
        o.stent && o.postdilate && wide > quarter(plan.reference_m) + 0.1 * mm) {
      plan.proximal = add(make_balloon(vascular::Compliance::non, o.oversize * std::min(wide, 5 * mm), 8 * mm), -1);
      plan.proximal_Pa = o.pressure * 14 * atm;
      plan.proximal_middle_m = plan.middle_m - length / 2 + 4.5 * mm;
    }
    out.plans.push_back(plan);
  }
  return out;
}

LesionNumbers measure(const Plan& plan, const vascular::FlowModel& flow, const vascular::PlaqueState& wall) {
  LesionNumbers out;
  double least = 1;
  for (std::size_t k = 0; k < plan.path.cells.size(); ++k)
    if (plan.path.s_m[k] >= plan.from_m && plan.path.s_m[k] <= plan.to_m)
      least = std::min(least, wall.radius_m[plan.path.cells[k]]);
  const double reference = plan.reference_m;
  out.mld_mm = 2 * least / mm, out.reference_mm = reference / mm;
  out.stenosis_percent = 100 * (1 - 2 * least / reference);
  const double behind = std::min(plan.to_m + 20 * mm, plan.path.length_m());
  out.ffr = ffr_model(flow, wall.radius_m, plan.path.cells[plan.path.at(behind).index]);
  return out;
}

StentNumbers measure(const Plan& plan, const vascular::StentModel& model, const vascular::StentState& stent,
                     const vascular::PlaqueState& wall) {
  StentNumbers out;
  const auto [least, most] = std::minmax_element(stent.radius_m.begin(), stent.radius_m.end());
  (void)most;
  double recoil = 0;
  for (int k = 0; k < model.rings; ++k) recoil += (1 - stent.radius_m[k] / stent.peak_m[k]) / model.rings;
  out.minimal_diameter_mm = 2 * *least / mm;
  out.minimal_area_mm2 = units::pi * *least * *least / (mm * mm);
  out.expansion_percent = 100 * std::pow(2 * *least / plan.reference_m, 2);
  const vascular::Apposition lies = apposition(model, stent, plan.path, wall);
  out.apposed_percent = 100 * lies.share, out.worst_gap_mm = lies.worst_m / mm;
  out.recoil_percent = 100 * recoil;
  const auto [from, to] = span_of(stent);
  out.length_mm = (to - from) / mm;
  out.foreshortening_percent = 100 * (1 - (to - from) / model.length_m);
  out.margin_proximal_mm = (plan.from_m - from) / mm, out.margin_distal_mm = (to - plan.to_m) / mm;
  const double covered = std::max(0.0, std::min(to, plan.to_m) - std::max(from, plan.from_m));
  out.coverage_percent = 100 * covered / (plan.to_m - plan.from_m);
  return out;
}

vascular::TreatmentReport Bedside::step(double dt_s) {
  device.shaft_m = shaft_m;
  const vascular::TreatmentReport report =
      vascular::step(treatment, device, dt_s, state, {physiology.flow, blood, inputs.occupied_m}, scratch);
  act(treatment.drugs, state.drugs, inputs.heart.body);
  inputs.heart.body.leak_m3_s = leak_m3_s(state);
  inputs.hyperaemia = state.drugs.adenosine;
  vascular::step(physiology, inputs, dt_s, blood, blood_scratch);
  if (each_step) each_step(*this);
  return report;
}

InflationRecord inflate(Bedside& bed, const Plan& plan, int balloon, double gauge_Pa, double hold_s) {
  constexpr double pump_Pa_s = 2 * atm, most_vacuum_s = 15;
  const vascular::BalloonModel& model = bed.treatment.balloons[balloon];
  InflationRecord record{.device = model.name};
  bed.device.balloons[0].balloon = balloon, bed.device.balloons[0].branch = plan.branch;
  bed.device.balloons[0].shaft.middle_m = balloon == plan.proximal ? plan.proximal_middle_m : plan.middle_m;
  bed.device.balloons[0].gauge_Pa = 0;
  bed.step();
  const double folded_m3 = bed.state.balloons[0].volume_m3;
  double full_m3 = 0;
  const auto note = [&](const vascular::TreatmentReport& report) {
    const vascular::BalloonState& s = bed.state.balloons[0];
    record.burst = record.burst || s.burst;
    record.ST_mV = std::max(record.ST_mV, ST_shift_mV(bed.physiology.ischaemia, bed.blood.ischaemia));
    record.slip_m = s.seat_m - bed.device.balloons[0].shaft.middle_m;
    if (s.pressure_Pa > 3.9 * atm && record.waist_at_4_atm == 1) record.waist_at_4_atm = report.balloons[0].waist;
    if (report.balloons[0].waist > 0.9 && record.waist_gave_Pa == 0 && s.pressure_Pa > 1.5 * atm)
      record.waist_gave_Pa = s.pressure_Pa;
    if (s.pressure_Pa < record.pressure_Pa) return;
    record.pressure_Pa = s.pressure_Pa, record.gauge_Pa = bed.device.balloons[0].gauge_Pa, full_m3 = s.volume_m3;
    double sum = 0, most = 0;
    int count = 0;
    for (int i = 0; i < vascular::balloon_spheres; ++i)
      if (sphere_share(model, i) == 1) sum += 2 * s.radius_m[i], ++count, most = std::max(most, 2 * s.radius_m[i]);
    record.diameter_m = sum / count, record.largest_over_reference = most / plan.reference_m;
  };
  for (double t = 0; t < gauge_Pa / pump_Pa_s + hold_s; t += 1e-3) {
    bed.device.balloons[0].gauge_Pa = std::min(gauge_Pa, pump_Pa_s * t);
    note(bed.step());
  }
  bed.device.balloons[0].gauge_Pa = -atm;
  for (double t = 0; t < most_vacuum_s && !is_empty(model, bed.state.balloons[0]); t += 1e-3) {
    bed.step();
    record.ST_mV = std::max(record.ST_mV, ST_shift_mV(bed.physiology.ischaemia, bed.blood.ischaemia));
    if (record.deflated_s == 0 && bed.state.balloons[0].volume_m3 - folded_m3 < 0.1 * (full_m3 - folded_m3))
      record.deflated_s = t;
  }
  bed.device.balloons[0].gauge_Pa = 0;
  return record;
}

std::vector<PlannedInflation> inflations_of(const Plan& plan) {
  std::vector<PlannedInflation> out;
  for (const PlannedInflation& i : {PlannedInflation{plan.predilate, plan.predilate_Pa},
                                    {plan.stent, plan.stent_Pa},
                                    {plan.postdilate, plan.postdilate_Pa},
                                    {plan.proximal, plan.proximal_Pa}})
    if (i.balloon >= 0) out.push_back(i);
  return out;
}

std::vector<InflationRecord> treat(Bedside& bed, const Plan& plan, double hold_s) {
  std::vector<InflationRecord> records;
  for (const PlannedInflation& i : inflations_of(plan))
    records.push_back(inflate(bed, plan, i.balloon, i.gauge_Pa, hold_s));
  bed.device.balloons[0].balloon = -1;
  for (int i = 0; i < 20; ++i) bed.step();
  return records;
}

}  // namespace ostium::app
