#include "app/session/model/outcome.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/base/units.h"

namespace ostium::app {

namespace {

constexpr double segment_m = 5e-3;

const Plan& plan_of(const SessionModel& model, int lesion) {
  return model.vessel->coronaries->lesions[static_cast<std::size_t>(lesion)];
}

bool in_artery_of(const Plan& plan, const SessionModel& model, double branch, double s_m) {
  return branch >= 0 && same_vessel(model.treatment.paths[static_cast<std::size_t>(branch)], plan.path, s_m);
}

/// Extent of a deployed stent in the lesion's artery, from the lesion's proximal end.
std::optional<Stretch> stretch_of(const vascular::StentState& stent, const Plan& plan, const SessionModel& model) {
  if (stent.where != vascular::StentState::deployed || !in_artery_of(plan, model, stent.branch, stent.middle_m))
    return {};
  const auto [from, to] = span_of(stent);
  return Stretch{from - plan.from_m, to - plan.from_m};
}

/// Length of the overlap; negative: of the gap.
double common_m(const Stretch& a, const Stretch& b) { return std::min(a.to_m, b.to_m) - std::max(a.from_m, b.from_m); }

}  // namespace

bool heart_rests(const SessionState& state) {
  const double phase = state.blood.heart.phase;
  return phase >= 0.68 && phase <= 0.84;
}

LesionNow lesion_now(const SessionModel& model, const SessionState& state, int lesion) {
  const Plan& plan = plan_of(model, lesion);
  LesionNow out{.mld_m = 1, .segment_mld_m = 1, .reference_m = plan.reference_m, .stenosis = 0};
  double from = plan.from_m - segment_m, to = plan.to_m + segment_m;
  if (const auto stent = stented(model, state, lesion)) {
    from = std::min(from, plan.from_m + stent->from_m - segment_m);
    to = std::max(to, plan.from_m + stent->to_m + segment_m);
  }
  for (std::size_t k = 0; k < plan.path.cells.size(); ++k) {
    const double s = plan.path.s_m[k],
                 d = 2 * state.treatment.wall.radius_m[static_cast<std::size_t>(plan.path.cells[k])];
    if (s >= plan.from_m && s <= plan.to_m) out.mld_m = std::min(out.mld_m, d);
    if (s >= from && s <= to) out.segment_mld_m = std::min(out.segment_mld_m, d);
  }
  out.stenosis = 1 - out.mld_m / out.reference_m;
  return out;
}

double supply_behind_lesion(const SessionModel& model, const SessionState& state, int lesion) {
  const Plan& plan = plan_of(model, lesion);
  const vascular::FlowTree& tree = model.physiology.flow.tree;
  const int end = plan.path.cells[static_cast<std::size_t>(plan.path.at(plan.to_m).index)];
  double flow = 0, need = 0;
  for (std::size_t b = 0; b < tree.branches.size(); ++b) {
    const vascular::FlowBranch& branch = tree.branches[b];
    if (branch.first == end || !tree.is_downstream(branch.first, end)) continue;
    flow += state.blood.flow.mean_m3_s[b];
    for (int c = branch.first; c < branch.last; ++c)
      need += model.physiology.flow.need_m3_s[static_cast<std::size_t>(c)];
  }
  if (need > 0) return flow / need;
  const int territory = static_cast<int>(tree.branches[static_cast<std::size_t>(plan.branch)].territory);
  return supply(model.physiology.flow, state.blood.flow)[static_cast<std::size_t>(territory)];
}

namespace {

/// Of the balloons in the lesion's artery the first in the body; null: there is none.
struct BalloonThere {
  const vascular::BalloonModel* model = nullptr;
  double middle_m = 0;
};
BalloonThere balloon_at(const Plan& plan, const SessionModel& model, const SessionState& state, int tool) {
  for (int nth = 0; nth < vascular::most_balloons; ++nth)
    if (const BalloonInBody own = balloon_in_body(state.coupling, state.treatment, {}, nth);
        own && (tool < 0 || own.place->tool == tool) && in_artery_of(plan, model, own.place->branch, own.state->seat_m))
      return {&model.treatment.balloons[static_cast<std::size_t>(own.place->balloon)], own.state->seat_m};
  return {};
}

}  // namespace

std::optional<double> balloon_from_lesion_m(const SessionModel& model, const SessionState& state, int lesion,
                                            int tool) {
  const Plan& plan = plan_of(model, lesion);
  const BalloonThere own = balloon_at(plan, model, state, tool);
  if (!own.model) return {};
  return own.middle_m - (plan.from_m + plan.to_m) / 2;
}

std::optional<double> balloon_beyond_lesion_m(const SessionModel& model, const SessionState& state, int lesion,
                                              int tool) {
  const std::optional<double> from_middle_m = balloon_from_lesion_m(model, state, lesion, tool);
  if (!from_middle_m) return {};
  const Plan& plan = plan_of(model, lesion);
  const double length_m = balloon_at(plan, model, state, tool).model->length_m;
  return (length_m - (plan.to_m - plan.from_m)) / 2 - std::fabs(*from_middle_m);
}

std::optional<Stretch> stented(const SessionModel& model, const SessionState& state, int lesion) {
  const Plan& plan = plan_of(model, lesion);
  const Stretch ill{0, plan.to_m - plan.from_m};
  std::optional<Stretch> out;
  for (const vascular::StentState& stent : state.treatment.stents)
    if (const auto own = stretch_of(stent, plan, model); own && (!out || common_m(*own, ill) > common_m(*out, ill)))
      out = own;
  // Each pass adds at least one stent that touches the stretch so far.
  for (bool grows = out.has_value(); grows;) {
    grows = false;
    for (const vascular::StentState& stent : state.treatment.stents) {
      const auto own = stretch_of(stent, plan, model);
      if (!own || common_m(*own, *out) < 0 || (own->from_m >= out->from_m && own->to_m <= out->to_m)) continue;
      out = Stretch{std::min(out->from_m, own->from_m), std::max(out->to_m, own->to_m)}, grows = true;
    }
  }
  return out;
}

std::optional<double> stent_from_lesion_m(const SessionModel& model, const SessionState& state, int stent, int lesion) {
  const Plan& plan = plan_of(model, lesion);
  const auto own = stretch_of(state.treatment.stents[static_cast<std::size_t>(stent)], plan, model);
  if (!own) return {};
  return (own->from_m + own->to_m - (plan.to_m - plan.from_m)) / 2;
}

bool lesion_is_covered(const SessionModel& model, const SessionState& state, double margin_m, int lesion) {
  const auto stent = stented(model, state, lesion);
  if (!stent) return false;
  const Plan& plan = plan_of(model, lesion);
  const double ahead = std::min(margin_m, plan.from_m),
               behind = std::min(margin_m, std::max(0.0, plan.path.length_m() - plan.to_m));
  return stent->from_m <= -ahead && stent->to_m >= plan.to_m - plan.from_m + behind;
}

WorstOfLesions worst_of_lesions(const SessionModel& model, const SessionState& state) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  WorstOfLesions out{.stenosis = -endless, .margin_m = endless};
  for (int i = 0; i < static_cast<int>(model.vessel->coronaries->lesions.size()); ++i) {
    const Plan& plan = plan_of(model, i);
    out.stenosis = std::max(out.stenosis, lesion_now(model, state, i).stenosis);
    const auto stent = stented(model, state, i);
    if (!stent) out.margin_m.reset();
    if (out.margin_m) out.margin_m = std::min({*out.margin_m, -stent->from_m, stent->to_m - (plan.to_m - plan.from_m)});
  }
  return out;
}

bool is_unharmed(const SessionModel& model, const SessionState& state) {
  constexpr int type_C = 2;
  const auto lies_under_a_stent = [&](int cell) {
    return std::any_of(
        state.treatment.stents.begin(), state.treatment.stents.end(), [&](const vascular::StentState& stent) {
          if (stent.where != vascular::StentState::deployed || stent.branch < 0) return false;
          const vascular::VesselPath& path = model.treatment.paths[static_cast<std::size_t>(stent.branch)];
          const auto at = std::find(path.cells.begin(), path.cells.end(), cell);
          if (at == path.cells.end()) return false;
          const double s = path.s_m[static_cast<std::size_t>(at - path.cells.begin())];
          const auto [from, to] = span_of(stent);
          return s >= from && s <= to;
        });
  };
  return std::none_of(state.treatment.injury.injuries.begin(), state.treatment.injury.injuries.end(),
                      [&](const vascular::Injury& injury) {
                        const auto kind = injury.kind;
                        if (injury.cell < 0 || kind == vascular::InjuryKind::none) return false;
                        return kind == vascular::InjuryKind::perforation ||
                               (injury.grade >= type_C && !lies_under_a_stent(injury.cell));
                      });
}

std::string patient_words(const SessionState& state) {
  using units::mmHg, units::mL;
  const vascular::HeartState& heart = state.blood.heart;
  const double round_mL = heart.circulation.pericardium_m3 / mL, leak_mL_s = leak_m3_s(state.treatment) / mL;
  const bool perforated = std::any_of(
      state.treatment.injury.injuries.begin(), state.treatment.injury.injuries.end(),
      [](const vascular::Injury& one) { return one.kind == vascular::InjuryKind::perforation && one.hole_m2 > 0; });
  if (!perforated && round_mL < 1 && heart.pulseless_s == 0 && heart.rhythm == vascular::Rhythm::sinus) return "";
  std::string words = heart.rhythm == vascular::Rhythm::asystole ? "dead: the heart stands still"
                      : heart.pulseless_s > 0 ? fmt::format("without a pulse for {:.0f} s", heart.pulseless_s)
                                              : "alive";
  words += fmt::format(": {:.0f}/{:.0f} mmHg, ", heart.beat.systolic_Pa / mmHg, heart.beat.diastolic_Pa / mmHg);
  if (heart.pulseless_s == 0) words += fmt::format("{:.0f} beats a minute, ", 60 / heart.cycle_s);
  words += vascular::rhythm_names[static_cast<std::size_t>(heart.rhythm)];
  if (round_mL >= 1) words += fmt::format(", {:.0f} mL round the heart", round_mL);
  if (perforated)
    words += leak_m3_s(state.treatment) > visible_leak_m3_s ? fmt::format(", perforation leaks {:.2f} mL/s", leak_mL_s)
                                                            : ", perforation closed";
  return words;
}

std::optional<StentNow> stent_now(const SessionModel& model, const SessionState& state, int lesion) {
  const Plan& plan = plan_of(model, lesion);
  const auto at_it = stented(model, state, lesion);
  std::optional<StentNow> out;
  for (std::size_t i = 0; i < state.treatment.stents.size(); ++i) {
    const vascular::StentState& stent = state.treatment.stents[i];
    const auto lies_at = stretch_of(stent, plan, model);
    if (!lies_at || common_m(*lies_at, *at_it) < 0) continue;
    const double least = *std::min_element(stent.radius_m.begin(), stent.radius_m.end());
    const double full = units::pi / 4 * plan.reference_m * plan.reference_m;
    const double area = units::pi * least * least;
    const vascular::Apposition lies =
        apposition(model.treatment.stents[i], stent, model.treatment.paths[static_cast<std::size_t>(stent.branch)],
                   state.treatment.wall);
    const StentNow own{area, area / full, lies.share};
    out = out ? StentNow{std::min(out->minimal_area_m2, own.minimal_area_m2), std::min(out->expansion, own.expansion),
                         std::min(out->apposed, own.apposed)}
              : own;
  }
  return out;
}

double ffr_behind_lesion(const SessionModel& model, const SessionState& state, int lesion) {
  return measure(plan_of(model, lesion), model.physiology.flow, state.treatment.wall).ffr;
}

double balloon_artery_ratio(const SessionModel& model, const SessionState& state) {
  double ratio = 0;
  for (int k = 0; k < vascular::most_balloons; ++k) {
    const CoupledBalloon& place = state.coupling.balloons[k];
    const vascular::BalloonState& own = state.treatment.balloons[k];
    if (place.balloon < 0 || place.branch < 0 || !(own.pressure_Pa > 101325)) continue;
    const vascular::BalloonModel& balloon = model.treatment.balloons[static_cast<std::size_t>(place.balloon)];
    const vascular::VesselPath& path = model.treatment.paths[static_cast<std::size_t>(place.branch)];
    for (int i = 0; i < vascular::balloon_spheres; ++i) {
      if (sphere_share(balloon, i) < 1) continue;
      const auto at = path.at(sphere_position(balloon, own, i));
      const vascular::FlowCell& cell =
          model.physiology.flow.tree.cells[static_cast<std::size_t>(path.cells[static_cast<std::size_t>(at.index)])];
      ratio = std::max(ratio, own.radius_m[static_cast<std::size_t>(i)] / cell.healthy_m);
    }
  }
  return ratio;
}

}  // namespace ostium::app
