#include "app/session/outcome.h"

#include <algorithm>
#include <numbers>

namespace ostium {

namespace {

constexpr double segment_m = 5e-3;

const Plan& lesion(const SessionModel& model) { return model.vessel->coronaries->lesions.front(); }

bool in_lesions_artery(const SessionModel& model, double branch, double s_m) {
  return branch >= 0 && same_vessel(model.treatment.paths[static_cast<std::size_t>(branch)], lesion(model).path, s_m);
}

}  // namespace

bool heart_rests(const SessionState& state) {
  const double phase = state.blood.heart.phase;
  return phase >= 0.68 && phase <= 0.84;
}

LesionNow lesion_now(const SessionModel& model, const SessionState& state) {
  const Plan& plan = lesion(model);
  LesionNow out{.mld_m = 1, .segment_mld_m = 1, .reference_m = plan.reference_m, .stenosis = 0};
  double from = plan.from_m - segment_m, to = plan.to_m + segment_m;
  if (const auto stent = stented(model, state)) {
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

double supply_behind_lesion(const SessionModel& model, const SessionState& state) {
  const Plan& plan = lesion(model);
  const FlowTree& tree = model.physiology.flow.tree;
  const int end = plan.path.cells[static_cast<std::size_t>(plan.path.at(plan.to_m).index)];
  double flow = 0, need = 0;
  for (std::size_t b = 0; b < tree.branches.size(); ++b) {
    const FlowBranch& branch = tree.branches[b];
    if (branch.first == end || !tree.is_downstream(branch.first, end)) continue;
    flow += state.blood.flow.mean_m3_s[b];
    for (int c = branch.first; c < branch.last; ++c)
      need += model.physiology.flow.need_m3_s[static_cast<std::size_t>(c)];
  }
  if (need > 0) return flow / need;
  const int territory = static_cast<int>(tree.branches[static_cast<std::size_t>(plan.branch)].territory);
  return supply(model.physiology.flow, state.blood.flow)[static_cast<std::size_t>(territory)];
}

std::optional<double> balloon_from_lesion_m(const SessionModel& model, const SessionState& state) {
  const BedsideState& b = state.bedside;
  if (b.balloon < 0 || !in_lesions_artery(model, b.branch, seat_m(b))) return {};
  return seat_m(b) - (lesion(model).from_m + lesion(model).to_m) / 2;
}

std::optional<Stretch> stented(const SessionModel& model, const SessionState& state) {
  std::optional<Stretch> out;
  for (const StentState& stent : state.treatment.stents) {
    if (stent.where != StentState::deployed || !in_lesions_artery(model, stent.branch, stent.middle_m)) continue;
    const auto [from, to] = span_of(stent);
    const Stretch own{from - lesion(model).from_m, to - lesion(model).from_m};
    out = out ? Stretch{std::min(out->from_m, own.from_m), std::max(out->to_m, own.to_m)} : own;
  }
  return out;
}

std::optional<double> stent_from_lesion_m(const SessionModel& model, const SessionState& state, int stent) {
  const StentState& own = state.treatment.stents[static_cast<std::size_t>(stent)];
  if (own.where != StentState::deployed || !in_lesions_artery(model, own.branch, own.middle_m)) return {};
  const auto [from, to] = span_of(own);
  return (from + to - lesion(model).from_m - lesion(model).to_m) / 2;
}

bool lesion_is_covered(const SessionModel& model, const SessionState& state, double margin_m) {
  const auto stent = stented(model, state);
  if (!stent) return false;
  const Plan& plan = lesion(model);
  const double ahead = std::min(margin_m, plan.from_m),
               behind = std::min(margin_m, std::max(0.0, plan.path.length_m() - plan.to_m));
  return stent->from_m <= -ahead && stent->to_m >= plan.to_m - plan.from_m + behind;
}

bool is_unharmed(const SessionModel& model, const SessionState& state) {
  constexpr double type_C = 2;
  const auto lies_under_a_stent = [&](int cell) {
    return std::any_of(state.treatment.stents.begin(), state.treatment.stents.end(), [&](const StentState& stent) {
      if (stent.where != StentState::deployed || stent.branch < 0) return false;
      const VesselPath& path = model.treatment.paths[static_cast<std::size_t>(stent.branch)];
      const auto at = std::find(path.cells.begin(), path.cells.end(), cell);
      if (at == path.cells.end()) return false;
      const double s = path.s_m[static_cast<std::size_t>(at - path.cells.begin())];
      const auto [from, to] = span_of(stent);
      return s >= from && s <= to;
    });
  };
  return std::none_of(state.treatment.injury.injuries.begin(), state.treatment.injury.injuries.end(),
                      [&](const Injury& injury) {
                        const auto kind = static_cast<InjuryKind>(static_cast<int>(injury.kind));
                        if (injury.cell < 0 || kind == InjuryKind::none) return false;
                        return kind == InjuryKind::perforation ||
                               (injury.grade >= type_C && !lies_under_a_stent(static_cast<int>(injury.cell)));
                      });
}

std::optional<StentNow> stent_now(const SessionModel& model, const SessionState& state) {
  std::optional<StentNow> out;
  for (std::size_t i = 0; i < state.treatment.stents.size(); ++i) {
    const StentState& stent = state.treatment.stents[i];
    if (stent.where != StentState::deployed || !in_lesions_artery(model, stent.branch, stent.middle_m)) continue;
    const double least = *std::min_element(stent.radius_m.begin(), stent.radius_m.end());
    const double full = std::numbers::pi / 4 * lesion(model).reference_m * lesion(model).reference_m;
    const double area = std::numbers::pi * least * least;
    const Apposition lies =
        apposition(model.treatment.stents[i], stent, model.treatment.paths[static_cast<std::size_t>(stent.branch)],
                   state.treatment.wall);
    const StentNow own{area, area / full, lies.share};
    out = out ? StentNow{std::min(out->minimal_area_m2, own.minimal_area_m2), std::min(out->expansion, own.expansion),
                         std::min(out->apposed, own.apposed)}
              : own;
  }
  return out;
}

double ffr_behind_lesion(const SessionModel& model, const SessionState& state) {
  return measure(lesion(model), model.physiology.flow, state.treatment.wall).ffr;
}

double balloon_artery_ratio(const SessionModel& model, const SessionState& state) {
  const BedsideState& b = state.bedside;
  if (b.balloon < 0 || b.branch < 0 || !(state.treatment.balloon.pressure_Pa > 101325)) return 0;
  const BalloonModel& balloon = model.treatment.balloons[static_cast<std::size_t>(b.balloon)];
  const VesselPath& path = model.treatment.paths[static_cast<std::size_t>(b.branch)];
  double ratio = 0;
  for (int i = 0; i < balloon_spheres; ++i) {
    if (sphere_share(balloon, i) < 1) continue;
    const auto at = path.at(sphere_position(balloon, state.treatment.balloon, seat_m(b), i));
    const FlowCell& cell =
        model.physiology.flow.tree.cells[static_cast<std::size_t>(path.cells[static_cast<std::size_t>(at.index)])];
    ratio = std::max(ratio, state.treatment.balloon.radius_m[static_cast<std::size_t>(i)] / cell.healthy_m);
  }
  return ratio;
}

}  // namespace ostium
