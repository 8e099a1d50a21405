#include "vascular/flow/flow.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/units.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::vascular {

namespace {

using units::mmHg;

using units::pi;
constexpr double exponent = 2.6;       // of the diameter law
constexpr double shut_m = 15e-6;       // a gap this narrow lets no blood through
constexpr double shut_Pa_s_m3 = 1e19;  // its resistance
constexpr double collapsed = 1e-3;     // conductance of the muscle below its zero-flow pressure, relative to above
constexpr double new_throat = 0.8;     // an area this much smaller than the last starts another narrowing

/// The healthy diameter of a stretch, raised to the law's exponent.
double raised(const FlowTree& tree, int from, int to) {
  double sum = 0, length = 0;
  for (int c = from; c < to; ++c)
    sum += tree.cells[c].length_m * 2 * tree.cells[c].healthy_m, length += tree.cells[c].length_m;
  return std::pow(sum / length, exponent);
}

struct Ends {
  double first = 0, last = 0;  // diameter to that power
};
Ends ends_of(const FlowTree& tree, const FlowBranch& b) {
  constexpr double rounding_m = 3e-3, mean_m = 3e-3;  // the mouth is wide where it leaves its parent
  const double begins = std::min(rounding_m, 0.3 * tree.cells[b.last - 1].s_m);
  int from = b.first, to, last = b.last - 1;
  while (from + 1 < b.last && tree.cells[from].s_m - tree.cells[b.first].s_m < begins) ++from;
  for (to = from + 1; to < b.last && tree.cells[to].s_m - tree.cells[from].s_m < mean_m; ++to) {
  }
  while (last > from && tree.cells[b.last - 1].s_m - tree.cells[last].s_m < mean_m) --last;
  return {raised(tree, from, to), raised(tree, last, b.last)};
}

void set_needs(FlowModel& model, double total_m3_s) {
  const FlowTree& tree = model.tree;
  model.need_m3_s.assign(tree.cells.size(), 0);
  std::vector<double> through(tree.branches.size());  // inflow of each branch, children after parents
  for (int b = static_cast<int>(tree.branches.size()) - 1; b >= 0; --b) {
    const FlowBranch& branch = tree.branches[b];
    const Ends ends = ends_of(tree, branch);
    double sides = 0, at_end = 0;
    for (int c = branch.first; c < branch.last; ++c)
      for (int k = tree.side_first[c]; k < tree.side_first[c + 1]; ++k)
        (c + 1 < branch.last ? sides : at_end) += through[tree.sides[k]];
    const double end = branch.name == "LM" ? 0 : std::max(0.0, ends.last - at_end);
    // The left main has no side branches.
    const double along = branch.name == "LM" ? 0 : std::max(0.0, ends.first - (end + at_end) - sides);
    double length = 0;
    for (int c = branch.first; c < branch.last; ++c) length += tree.cells[c].length_m;
    for (int c = branch.first; c < branch.last; ++c) model.need_m3_s[c] += along * tree.cells[c].length_m / length;
    model.need_m3_s[branch.last - 1] += end;
    through[b] = along + sides + end + at_end;
  }
  double sum = 0;
  for (double n : model.need_m3_s) sum += n;
  for (double& n : model.need_m3_s) n *= total_m3_s / sum;
}

double pressure_of_no_flow(const FlowModel& model, Territory territory, const Pressures& p) {
  return std::max(model.zero_flow_Pa, model.squeeze[static_cast<std::size_t>(territory)] * p.ventricle_Pa);
}

/// Poiseuille resistance and separation loss of each cell.
void set_losses(const FlowModel& model, std::span<const double> radius_m, std::span<const double> occupied_m,
                std::span<const double> flow_m3_s, FlowScratch& x) {
  const FlowTree& tree = model.tree;
  const double loss = model.separation * model.density_kg_m3 / 2;
  for (const FlowBranch& b : tree.branches) {
    double throat = 0, before = 0, spent = 0;
    for (int c = b.first; c < b.last; ++c) {
      const double r = radius_m[c], a = occupied_m.empty() ? 0 : occupied_m[c], area = free_area_m2(r, a);
      if (r - a < shut_m) {
        x.R[c] = shut_Pa_s_m3, x.E[c] = 0, throat = 0;
        continue;
      }
      const double r2 = r * r, a2 = a * a;
      const double fourth = a > 0 ? r2 * r2 - a2 * a2 - (r2 - a2) * (r2 - a2) / std::log(r / a) : r2 * r2;
      x.R[c] = 8 * model.viscosity_Pa_s * tree.cells[c].length_m / (pi * fourth);
      // Loss from the throat to here, minus the part already counted upstream.
      if (throat == 0 || area < throat || area < new_throat * before) throat = area, spent = 0;
      const double all = loss * (1 / throat - 1 / area) * (1 / throat - 1 / area), B = std::max(0.0, all - spent);
      spent = std::max(spent, all), before = area;
      // Newton's method: B Q |Q| linearised about the last flow.
      const double Q = flow_m3_s[c];
      x.R[c] += 2 * B * std::fabs(Q);
      x.E[c] = B * Q * std::fabs(Q);
    }
  }
}

void solve(const FlowTree& tree, double p_root, FlowScratch& x, FlowState& s) {
  const int n = static_cast<int>(tree.cells.size());
  for (int c = 0; c < n; ++c) x.G[c] = x.g[c], x.S[c] = x.g[c] * x.pz[c];
  for (int c = n - 1; c >= 0; --c) {
    const int up = tree.cells[c].upstream;
    if (up < 0) continue;
    const double share = 1 / (1 + x.R[c] * x.G[c]);
    x.G[up] += x.G[c] * share;
    x.S[up] += (x.S[c] - x.E[c] * x.G[c]) * share;
  }
  for (int c = 0; c < n; ++c) {
    const int up = tree.cells[c].upstream;
    const double p_up = (up < 0 ? p_root : s.pressure_Pa[up]) + x.E[c];
    // Both relative to the downstream side: accurate even where the resistance is huge.
    const double share = 1 / (1 + x.R[c] * x.G[c]);
    s.flow_m3_s[c] = (p_up * x.G[c] - x.S[c]) * share;
    s.pressure_Pa[c] = (p_up + x.R[c] * x.S[c]) * share;
    s.leak_m3_s[c] = x.g[c] * (s.pressure_Pa[c] - x.pz[c]);
  }
}

void resize(FlowScratch& x, std::size_t n) {
  for (auto* v : {&x.R, &x.E, &x.G, &x.S, &x.g, &x.pz}) v->resize(n);
}

/// Mean pressure that drives flow into the myocardium, over a beat at 120/80 mmHg.
double mean_drive_Pa(const FlowModel& model, Territory territory) {
  HeartModel heart;
  HeartState h;
  double sum = 0;
  constexpr double dt = 2e-3;
  int count = 0;
  for (double t = 0; t < 30; t += dt) {
    step(heart, {}, dt, h);
    if (t < 20) continue;
    const Pressures p = pressures(heart, h);
    sum += std::max(0.0, p.aorta_Pa - pressure_of_no_flow(model, territory, p)), ++count;
  }
  return sum / count;
}

}  // namespace

double free_area_m2(double radius_m, double occupied_m) {
  return std::max(0.0, pi * (radius_m * radius_m - occupied_m * occupied_m));
}

FlowModel make_flow_model(FlowTree tree, double total_m3_s) {
  FlowModel model{.tree = std::move(tree), .need_m3_s = {}, .leak_m3_sPa = {}};
  set_needs(model, total_m3_s);
  std::array<double, territories> drive;
  for (int t = 0; t < territories; ++t) drive[t] = mean_drive_Pa(model, static_cast<Territory>(t));
  for (std::size_t c = 0; c < model.tree.cells.size(); ++c)
    model.leak_m3_sPa.push_back(
        model.need_m3_s[c] /
        drive[static_cast<std::size_t>(model.tree.branches[model.tree.cells[c].branch].territory)]);
  return model;
}

FlowState make_flow_state(const FlowModel& model) {
  const std::size_t n = model.tree.cells.size(), b = model.tree.branches.size();
  FlowState s;
  s.flow_m3_s.assign(n, 0), s.pressure_Pa.assign(n, 93 * mmHg), s.leak_m3_s = model.need_m3_s;
  for (int c = static_cast<int>(n) - 1; c >= 0; --c) {
    s.flow_m3_s[c] += model.need_m3_s[c];
    if (const int up = model.tree.cells[c].upstream; up >= 0) s.flow_m3_s[up] += s.flow_m3_s[c];
  }
  s.tone.assign(b, 1), s.mean_m3_s.assign(b, 0), s.no_reflow.assign(b, 0);
  for (std::size_t c = 0; c < n; ++c) s.mean_m3_s[model.tree.cells[c].branch] += model.need_m3_s[c];
  return s;
}

void step(const FlowModel& model, const FlowInputs& in, double dt_s, FlowState& s, FlowScratch& x) {
  const FlowTree& tree = model.tree;
  const std::size_t n = tree.cells.size();
  assert(in.radius_m.size() == n && (in.occupied_m.empty() || in.occupied_m.size() == n));
  resize(x, n);
  for (std::size_t b = 0; b < tree.branches.size(); ++b) {
    const FlowBranch& branch = tree.branches[b];
    const double pz = pressure_of_no_flow(model, branch.territory, in.pressures);
    const double tone = std::max(s.tone[b], 1 + in.hyperaemia * (model.most_dilated - 1)) * (1 - s.no_reflow[b]) *
                        (in.open.empty() ? 1 : in.open[b]);
    for (int c = branch.first; c < branch.last; ++c) {
      x.pz[c] = pz;
      x.g[c] = model.leak_m3_sPa[c] * tone * (s.pressure_Pa[c] > pz ? 1 : collapsed);
    }
  }
  set_losses(model, in.radius_m, in.occupied_m, s.flow_m3_s, x);
  solve(tree, in.pressures.aorta_Pa, x, s);
  const double share = -std::expm1(-dt_s / model.averaging_s);
  for (std::size_t b = 0; b < tree.branches.size(); ++b) {
    const FlowBranch& branch = tree.branches[b];
    double leak = 0, need = 0;
    for (int c = branch.first; c < branch.last; ++c) leak += s.leak_m3_s[c], need += model.need_m3_s[c];
    s.mean_m3_s[b] += share * (leak - s.mean_m3_s[b]);
    if (need <= 0) continue;
    const double wanted = s.tone[b] * need / std::max(s.mean_m3_s[b], 0.05 * need);
    const double target = std::clamp(wanted, 0.8, model.most_dilated);
    s.tone[b] += -std::expm1(-dt_s / model.tone_s) * (target - s.tone[b]);
  }
}

std::array<double, territories> supply(const FlowModel& model, const FlowState& s) {
  std::array<double, territories> flow{}, need{};
  for (std::size_t b = 0; b < model.tree.branches.size(); ++b)
    flow[static_cast<std::size_t>(model.tree.branches[b].territory)] += s.mean_m3_s[b];
  for (std::size_t c = 0; c < model.tree.cells.size(); ++c)
    need[static_cast<std::size_t>(model.tree.branches[model.tree.cells[c].branch].territory)] += model.need_m3_s[c];
  for (std::size_t t = 0; t < territories; ++t) flow[t] = need[t] > 0 ? flow[t] / need[t] : 1;
  return flow;
}

double ffr_model(const FlowModel& model, std::span<const double> radius_m, int cell) {
  FlowState s = make_flow_state(model);
  FlowScratch x;
  resize(x, model.tree.cells.size());
  const Pressures mean{93 * mmHg, 0};
  for (int round = 0; round < 40; ++round) {
    for (std::size_t c = 0; c < model.tree.cells.size(); ++c) {
      x.pz[c] = model.zero_flow_Pa;
      // The ventricle's squeeze is included in a conductance that meets the need at mean pressure.
      x.g[c] = model.need_m3_s[c] / (mean.aorta_Pa - model.zero_flow_Pa) * model.most_dilated;
    }
    set_losses(model, radius_m, {}, s.flow_m3_s, x);
    solve(model.tree, mean.aorta_Pa, x, s);
  }
  return s.pressure_Pa[cell] / mean.aorta_Pa;
}

}  // namespace ostium::vascular
