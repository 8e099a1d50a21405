#include "vascular/physiology/air.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/random.h"
#include "core/base/units.h"

namespace ostium::vascular {

namespace {

constexpr std::uint64_t fibrillates = 61;  // stream of random numbers
constexpr double mean_Pa = 93 * units::mmHg;
constexpr double least_m3 = 1e-12;  // of a bubble: 0.1 mm across

/// The cell at which what leaves the tip enters the tree, and the share of it that does.
struct Entry {
  int cell = -1;
  double share = 0;
};
Entry entry_of(const ContrastModel& roots, const FlowTree& tree, const TipPlace& tip) {
  if (tip.where == TipPlace::coronary) return {tip.cell, 1};
  if (tip.where != TipPlace::left_sinus && tip.where != TipPlace::right_sinus) return {};
  const int branch = roots.coronary_branch[tip.where == TipPlace::right_sinus];
  if (branch < 0) return {};
  return {tree.branches[static_cast<std::size_t>(branch)].first, std::clamp(tip.into_ostium, 0.0, 1.0)};
}

/// Whether blood from a cell reaches a branch's muscle.
bool feeds(const FlowTree& tree, int cell, int branch) {
  return tree.cells[static_cast<std::size_t>(cell)].branch == branch ||
         tree.is_downstream(tree.branches[static_cast<std::size_t>(branch)].first, cell);
}

void spread(const FlowTree& tree, const FlowState& blood, int cell, double volume_m3, AirState& s) {
  const int branches = static_cast<int>(tree.branches.size());
  double all = 0;
  for (int b = 0; b < branches; ++b)
    if (feeds(tree, cell, b)) all += std::max(0.0, blood.mean_m3_s[static_cast<std::size_t>(b)]);
  for (int b = 0; b < branches; ++b)
    if (feeds(tree, cell, b))
      s.muscle_m3[static_cast<std::size_t>(b)] +=
          all > 0 ? volume_m3 * std::max(0.0, blood.mean_m3_s[static_cast<std::size_t>(b)]) / all : 0;
  if (all <= 0) s.elsewhere_m3 += volume_m3;
}

}  // namespace

void add_to_line(double volume_m3, AirState& s) {
  if (!(volume_m3 > 0)) return;
  if (s.line_m3 <= 0) s.line_at = 0;
  s.line_m3 += volume_m3;
}

double step(const AirModel& model, const ContrastModel& roots, const FlowModel& flow, const FlowState& blood,
            const AirInputs& in, double dt, AirState& s) {
  double came = 0;
  if (s.line_m3 > 0) {
    s.line_at += in.pushed_m3 / in.dead_m3;
    if (s.line_at >= 1) {
      const Entry entry = entry_of(roots, flow.tree, in.tip);
      came = entry.share * s.line_m3;
      s.elsewhere_m3 += s.line_m3 - came;
      if (entry.cell >= 0) spread(flow.tree, blood, entry.cell, came, s);
    } else if (s.line_at < 0) {
      s.elsewhere_m3 += s.line_m3;  // into the syringe
    }
    if (s.line_at >= 1 || s.line_at < 0) s.line_m3 = s.line_at = 0;
  }
  const double share = -std::expm1(-dt * std::max(0.0, in.aorta_Pa) / (mean_Pa * model.leaves_s));
  for (double& volume : s.muscle_m3) {
    const double gone = volume < least_m3 ? volume : share * volume;
    volume -= gone, s.elsewhere_m3 += gone;
  }
  return came;
}

void open_share(const AirModel& model, const FlowModel& flow, const AirState& s, std::vector<double>& open) {
  open.assign(s.muscle_m3.size(), 1);
  for (std::size_t b = 0; b < open.size(); ++b) {
    if (s.muscle_m3[b] <= 0) continue;
    const FlowBranch& branch = flow.tree.branches[b];
    const double need =
        std::accumulate(flow.need_m3_s.begin() + branch.first, flow.need_m3_s.begin() + branch.last, 0.0);
    open[b] = need > 0 ? std::exp(-s.muscle_m3[b] / (model.closes_s * need)) : 1;
  }
}

double in_muscle_m3(const AirState& s) { return std::accumulate(s.muscle_m3.begin(), s.muscle_m3.end(), 0.0); }

bool is_fatal(const AirModel& model, std::uint64_t seed, double volume_m3) {
  const double of_fatal = volume_m3 / model.fatal_m3;
  const double hazard = -std::log1p(-model.fatal_share) * of_fatal * of_fatal;
  return hazard > -std::log1p(-core::uniform(seed, fibrillates, 0));
}

}  // namespace ostium::vascular
