#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "vascular/contrast/contrast_step.h"

namespace ostium::vascular {

namespace {

using units::pi;
constexpr double thickest_kg_m3 = 400;  // above this a cell has lost volume: the excess is pushed upstream
constexpr double traces_kg = 1e-16;     // per cell: invisible amounts that would only cost time

}  // namespace

void ContrastStep::measure() {
  x.cell_m3.resize(n());
  for (std::size_t c = 0; c < n(); ++c) {
    const double occupied = now.lumen.occupied_m.empty() ? 0 : now.lumen.occupied_m[c];
    x.cell_m3[c] = std::max(least_m3, now.flow.tree.cells[c].length_m * free_area_m2(now.lumen.radius_m[c], occupied));
  }
}

void ContrastStep::push_out_excess() {
  for (int c = static_cast<int>(n()) - 1; c >= 0; --c) {
    const int up = now.flow.tree.cells[c].upstream;
    double kg = 0;
    for (int k = 0; k < layers; ++k) kg += s.sheath_kg[k * n() + c];
    const double most = thickest_kg_m3 * volume(c);
    if (kg <= most) continue;
    for (int k = 0; k < layers; ++k) {
      double& m = s.sheath_kg[k * n() + c];
      const double excess = m * (1 - most / kg);
      m -= excess;
      (up >= 0 ? s.sheath_kg[k * n() + up] : s.sinus_kg[c == root(1)]) += excess;
    }
  }
}

void ContrastStep::run_branch(int b) {
  const FlowTree& tree = now.flow.tree;
  const FlowBranch& branch = tree.branches[b];
  const int first = branch.first, cells = branch.cells();
  // Inflow from upstream: from the parent's updated state; at the ostium from the sinus.
  const double coming = through(first);
  double inlet_kg_m3;
  if (branch.parent >= 0) {
    inlet_kg_m3 = coming > 0 ? x.inlet[b] / coming : 0;
  } else {
    const int side = b == model.coronary_branch[1];
    inlet_kg_m3 = sinus_kg_m3(side);
    s.sinus_kg[side] -= inlet_kg_m3 * coming;
  }
  // A tip in the first cell injects into the inflow, so that it mixes before moving on.
  const bool tip_here = x.entering[n() + first] > 0;
  const double entering_m3 = tip_here ? x.entering[first] : 0, entering_kg = tip_here ? x.entering[n() + first] : 0;
  if (coming + entering_m3 > 0) inlet_kg_m3 = (inlet_kg_m3 * coming + entering_kg) / (coming + entering_m3);
  bool clear = inlet_kg_m3 == 0;
  for (int k = 0; k < layers; ++k)
    for (int i = 0; i < cells; ++i)
      clear = clear && s.sheath_kg[k * n() + first + i] == 0 && x.entering[n() + first + i] == 0;
  if (clear) return;
  x.volume.resize(cells), x.mass.resize(cells), x.passing.resize(cells + 1), x.through.resize(cells + 1);
  for (int k = 0; k < layers; ++k) {
    double* mass = &s.sheath_kg[k * n() + first];
    for (int i = 0; i < cells; ++i) x.volume[i] = model.share[k] * volume(first + i), x.mass[i] = mass[i];
    for (int i = 0; i < cells; ++i) x.passing[i] = through(first + i) / layers;
    x.passing[0] = (coming + entering_m3) / layers, x.passing[cells] = 0;
    carry(x.mass, x.volume, x.passing, inlet_kg_m3, x.through, x.carry);
    for (int i = 0; i < cells; ++i)
      mass[i] += x.through[i] - x.through[i + 1] + (i > 0 ? x.entering[n() + first + i] / layers : 0);
  }
  for (int i = 0; i < cells; ++i) leave(first + i);
}

void ContrastStep::leave(int c) {
  const FlowTree& tree = now.flow.tree;
  double& muscle_kg = s.muscle_kg[tree.branches[tree.cells[c].branch].territory == Territory::rca ? 1 : 0];
  double all = 0;
  for (int k = 0; k < layers; ++k) all += s.sheath_kg[k * n() + c];
  if (all < traces_kg) {
    muscle_kg += all;
    for (int k = 0; k < layers; ++k) s.sheath_kg[k * n() + c] = 0;
    return;
  }
  const double mixing = std::max(model.mixes[c], mixing_now), V = volume(c);
  const double leak = std::max(0.0, now.state.leak_m3_s[c]) * dt / layers;
  double sides = 0;
  for (int j = tree.side_first[c]; j < tree.side_first[c + 1]; ++j)
    sides += through(tree.branches[tree.sides[j]].first) / layers;
  for (int k = 0; k < layers; ++k) {
    double& m = s.sheath_kg[k * n() + c];
    const double with_leaving = model.share[k] * V + leak + sides;
    m += mixing * (with_leaving / (V + layers * (leak + sides)) * all - m);
    const double kg_m3 = m / with_leaving;
    muscle_kg += kg_m3 * leak;
    for (int j = tree.side_first[c]; j < tree.side_first[c + 1]; ++j) {
      const int child = tree.sides[j];
      x.inlet[child] += kg_m3 * through(tree.branches[child].first) / layers;
    }
    m -= kg_m3 * (leak + sides);
  }
}

void ContrastStep::disperse() {
  for (const FlowBranch& branch : now.flow.tree.branches)
    for (int c = branch.first; c + 1 < branch.last; ++c) {
      if (s.sheath_kg[c] == 0 && s.sheath_kg[c + 1] == 0) continue;  // the fastest sheath is ahead of the others
      const FlowCell &a = now.flow.tree.cells[c], &b = now.flow.tree.cells[c + 1];
      const double Va = volume(c), Vb = volume(c + 1), apart = (a.length_m + b.length_m) / 2;
      const double exchanged = std::min(model.dispersion_m2_s * dt / apart * std::min(Va / a.length_m, Vb / b.length_m),
                                        0.2 * std::min(Va, Vb));
      for (int k = 0; k < layers; ++k) {
        double &ma = s.sheath_kg[k * n() + c], &mb = s.sheath_kg[k * n() + c + 1];
        const double kg = exchanged * (ma / Va - mb / Vb);
        ma -= kg, mb += kg;
      }
    }
}

void ContrastStep::run_aorta() {
  const int cells = static_cast<int>(s.aorta_kg.size());
  for (int side = 0; side < 2; ++side) {
    const int at = std::min(model.ostium_cell[side], cells - 1);
    const double c_root = aorta_concentration(model, s, at);
    const double exchanged =
        std::min(0.5 * model.sinus_m3, (model.sinus_flow_m3_s + model.sinus_share * std::fabs(now.ejection_m3_s)) * dt);
    const double drawn = root(side) < 0 ? 0 : std::max(0.0, now.state.flow_m3_s[root(side)]) * dt;
    const double kg = exchanged * (sinus_kg_m3(side) - c_root) - drawn * c_root;
    s.sinus_kg[side] -= kg, s.aorta_kg[at] += kg;
  }
  x.volume.resize(cells), x.through.resize(cells + 1);
  for (int i = 0; i < cells; ++i)
    x.volume[i] = pi * model.aorta_radius_m[i] * model.aorta_radius_m[i] * model.aorta_length_m[i];
  x.mass.assign(s.aorta_kg.begin(), s.aorta_kg.end());
  x.passing.assign(cells + 1, std::max(0.0, now.ejection_m3_s) * dt);
  carry(x.mass, x.volume, x.passing, 0, x.through, x.carry);
  for (int i = 0; i < cells; ++i) s.aorta_kg[i] += x.through[i] - x.through[i + 1];
  s.carried_kg += x.through[cells];
}

ContrastReport step(const ContrastModel& model, const BloodNow& now, const ContrastInputs& inputs, double dt_s,
                    ContrastState& state, ContrastScratch& scratch) {
  ContrastStep run{model, now, inputs, dt_s, state, scratch};
  scratch.inlet.assign(now.flow.tree.branches.size(), 0);
  run.measure();
  run.inject();
  run.push_out_excess();
  for (std::size_t b = 0; b < now.flow.tree.branches.size(); ++b) run.run_branch(static_cast<int>(b));
  run.disperse();
  run.run_aorta();
  return run.report;
}

}  // namespace ostium::vascular
