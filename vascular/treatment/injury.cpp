#include "vascular/treatment/injury.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"

namespace ostium::vascular {

namespace {

constexpr std::uint64_t tear = 41, tear_grade = 42, hole = 43, hole_grade = 44, wire = 45, hole_size = 46,
                        balloon_seals = 47, flap = 48, jet_tears = 49;
constexpr double burst_tears = 0.5, burst_holes = 0.05;

bool exceeds(double hazard, std::uint64_t seed, std::uint64_t stream, int draws) {
  return hazard > -std::log1p(-core::uniform(seed, stream, static_cast<std::uint64_t>(draws)));
}

constexpr double discharge = 0.6, blood_kg_m3 = 1055;
constexpr double seals_alone = 0.545, sealed_so_far = 0.7;  // share of holes; of a hole that a balloon leaves open
// Clotting time constants of a hole of 0.5 mm without heparin, and of one that is covered. [estimates: periods of 10 to
// 15 minutes under a balloon are usual; wire exits bleed for hours]
constexpr double clots_s = 1800, clots_covered_s = 240, of_hole_m = 0.5e-3;
constexpr double act_normal_s = 130, act_none_s = 250;  // no clotting from here on
constexpr double flap_grows_s = 900;                    // [estimate: closure comes a median of 27 minutes later]

constexpr double forceful_m3_s = 3e-6, jet_H_m3 = 0.012e6;  // per m3
constexpr double runs_m_m3 = 3e-3 * 1e6, takes_1_m3 = 0.06e6, open_guide = 0.25, runs_at_most_m = 0.1,
                 takes_at_most = 0.95;
constexpr double spiral_m = 10e-3;  // from here on it is called D

/// Effective diameter, m.
double drawn_hole_m(const InjuryModel& model, int grade, int draw) {
  const double u = core::uniform(model.seed, hole_size, static_cast<std::uint64_t>(draw));
  switch (grade) {
    case 2:
      return (0.2 + 0.2 * u) * 1e-3;
    case 3:
      return (0.5 + 0.7 * u) * 1e-3;
    case 5:
      return (0.12 + 0.18 * u) * 1e-3;
    default:
      return 0;
  }
}

double flap_takes(const InjuryModel& model, int grade, int draw) {
  constexpr double of_grade[] = {0, 0.1, 0.35, 0.6, 0.5, 0.95};
  const double u = grade == 2 ? core::uniform(model.seed, flap, static_cast<std::uint64_t>(draw)) : 1;
  return of_grade[std::clamp(grade, 0, 5)] * u;
}

void add(const InjuryModel& model, InjuryState& s, InjuryKind kind, int cell, int grade, double time_s) {
  if (s.count >= most_injuries) return;
  Injury& injury = s.injuries[static_cast<std::size_t>(s.count)];
  injury.kind = kind, injury.cell = cell, injury.grade = grade, injury.time_s = time_s;
  if (kind == InjuryKind::perforation) {
    const double d = drawn_hole_m(model, grade, s.count);
    injury.hole_m2 = units::pi / 4 * d * d;
    const bool seals = core::uniform(model.seed, balloon_seals, static_cast<std::uint64_t>(s.count)) < seals_alone;
    injury.clots_at_most = seals ? 1 : sealed_so_far;
  } else {
    injury.will_narrow = flap_takes(model, grade, s.count);
  }
  s.count += 1;
}

}  // namespace

double chance(double hazard) { return -std::expm1(-hazard); }

double dissection_hazard(double ratio, bool calcified, bool eccentric, double length_m) {
  return 0.36 * std::exp(7 * (ratio - 1)) * (calcified ? 1.8 : 1) * (eccentric ? 1.4 : 1) * std::sqrt(length_m / 15e-3);
}

double perforation_hazard(double ratio, bool calcified) {
  return 0.0002 * std::exp(20 * (ratio - 1)) * (calcified ? 2 : 1);
}

void judge_stretch(const InjuryModel& model, const PlaqueModel& plaque, const PlaqueState& wall, double length_m,
                   bool burst, double time_s, InjuryState& s) {
  double tear_H = 0, hole_H = 0, ratio = 0, hole_ratio = 0;
  int tear_at = -1, hole_at = -1;
  for (std::size_t c = 0; c < plaque.cells.size(); ++c) {
    const PlaqueCell& cell = plaque.cells[c];
    const double x = wall.peak_m[c] / cell.healthy_m;
    const bool plaqued = cell.diseased_m < 0.97 * cell.healthy_m;
    if (wall.peak_m[c] <= cell.diseased_m * 1.001 || (!plaqued && x < 1.03)) continue;
    const double t = dissection_hazard(x, cell.calcified, cell.eccentric, length_m) * (plaqued ? 1 : 0.5);
    const double h = perforation_hazard(x, cell.calcified);
    if (t > tear_H) tear_H = t, tear_at = static_cast<int>(c), ratio = x;
    if (h > hole_H) hole_H = h, hole_at = static_cast<int>(c), hole_ratio = x;
  }
  // The largest hazard counts, not the sum: a stretch that was survived before adds nothing.
  s.dissection_H = std::max(s.dissection_H, tear_H) + (burst ? burst_tears : 0);
  s.perforation_H = std::max(s.perforation_H, hole_H) + (burst ? burst_holes : 0);
  if (tear_at >= 0 && s.dissection_draws < 1 && exceeds(s.dissection_H, model.seed, tear, 0)) {
    const double u = core::uniform(model.seed, tear_grade, 0),
                 major = std::clamp(0.3 * (1 + 4 * (ratio - 1)), 0.1, 0.8);
    // A and B are minor; C is the most common major grade.
    const int grade = u > major          ? (u > (1 + major) / 2 ? 0 : 1)
                      : u > 0.5 * major  ? 2
                      : u > 0.25 * major ? 3
                      : u > 0.1 * major  ? 4
                                         : 5;
    add(model, s, InjuryKind::dissection, tear_at, grade, time_s);
    s.dissection_draws = 1;
  }
  if (hole_at >= 0 && s.perforation_draws < 1 && exceeds(s.perforation_H, model.seed, hole, 0)) {
    const double u = core::uniform(model.seed, hole_grade, 0);
    // The farther stretched, the worse: Ellis I to III 30, 45, 25 % at a ratio of 1.3, nearly all III at 1.6
    // [estimate].
    const double far = std::clamp((hole_ratio - 1.3) / 0.3, 0.0, 1.0), mild = 0.3 * (1 - far), most = 0.75 - 0.65 * far;
    add(model, s, InjuryKind::perforation, hole_at, u < mild ? 1 : u < most ? 2 : 3, time_s);
    s.perforation_draws = 1;
  }
}

void judge_wire(const InjuryModel& model, int cell, double radius_m, double tip_N, double dt_s, double time_s,
                InjuryState& s) {
  const double load = tip_N / model.wire_N * (0.5e-3 / std::max(radius_m, 0.2e-3));
  if (load <= 1) return;
  s.wire_H += 0.05 * (load - 1) * (load - 1) * dt_s;
  if (s.wire_draws < 1 && exceeds(s.wire_H, model.seed, wire, 0)) {
    add(model, s, InjuryKind::perforation, cell, radius_m < 0.75e-3 ? 5 : 1, time_s);
    s.wire_draws = 1;
  }
}

void judge_jet(const InjuryModel& model, const GuideJet& jet, double dt_s, double time_s, InjuryState& s) {
  if (jet.cell < 0 || jet.m3_s < forceful_m3_s || jet.against_wall <= 0) return;
  s.jet_H += jet_H_m3 * jet.against_wall * jet.m3_s * dt_s;
  if (s.jet_draws < 1 && exceeds(s.jet_H, model.seed, jet_tears, 0)) {
    add(model, s, InjuryKind::dissection, jet.cell, 2, time_s);
    s.jet_draws = 1;
  }
}

void run_on(const GuideJet& jet, bool downstream, double dt_s, Injury& injury) {
  if (injury.kind != InjuryKind::dissection || !downstream || jet.m3_s < forceful_m3_s) return;
  const double m3 = jet.m3_s * dt_s * std::max(open_guide, jet.against_wall);
  injury.runs_m = std::min(runs_at_most_m, injury.runs_m + runs_m_m3 * m3);
  if (injury.will_narrow < takes_at_most)
    injury.will_narrow = std::min(takes_at_most, injury.will_narrow + takes_1_m3 * m3);
  injury.narrows = std::min(injury.will_narrow, injury.narrows + takes_1_m3 * m3);
  if (injury.grade < 3 && injury.runs_m > spiral_m) injury.grade = 3;
  if (injury.narrows > 0.9) injury.grade = 5;
}

void injure(const InjuryModel& model, InjuryKind kind, int cell, int grade, double size_m, double time_s,
            InjuryState& s) {
  const int before = s.count;
  add(model, s, kind, cell, grade, time_s);
  if (s.count > before && size_m > 0)
    s.injuries[static_cast<std::size_t>(before)].hole_m2 = units::pi / 4 * size_m * size_m;
}

double leak_m3_s(const Injury& injury, double across_Pa) {
  if (injury.kind != InjuryKind::perforation || injury.covered || across_Pa <= 0) return 0;
  return discharge * injury.hole_m2 * (1 - injury.clotted) * std::sqrt(2 * across_Pa / blood_kg_m3);
}

void age(double act_s, double dt_s, Injury& injury) {
  injury.narrows += -std::expm1(-dt_s / flap_grows_s) * (injury.will_narrow - injury.narrows);
  if (injury.kind != InjuryKind::perforation || injury.hole_m2 <= 0) return;
  const double fluid = std::clamp((act_s - act_normal_s) / (act_none_s - act_normal_s), 0.0, 1.0);
  const double area = units::pi / 4 * of_hole_m * of_hole_m;
  const double rate = injury.covered ? 1 / clots_covered_s : (1 - fluid) * area / injury.hole_m2 / clots_s;
  const double most = 1 - (1 - injury.clots_at_most) * fluid;
  if (injury.clotted < most) injury.clotted = std::min(most, injury.clotted + rate * dt_s);
}

double pocket_m3(const Injury& injury) {
  if (injury.kind == InjuryKind::perforation) return 0.02e-6;  // the crater
  constexpr double of_grade[] = {0.004e-6, 0.01e-6, 0.04e-6, 0.05e-6, 0.05e-6, 0.06e-6};
  return of_grade[std::clamp(injury.grade, 0, 5)];
}

const char* grade_name(const Injury& injury) {
  constexpr const char* tears[] = {"A", "B", "C", "D", "E", "F"};
  constexpr const char* holes[] = {"", "I", "II", "III", "", "V"};
  const int g = std::clamp(injury.grade, 0, 5);
  return injury.kind == InjuryKind::dissection ? tears[g] : holes[g];
}

}  // namespace ostium::vascular
