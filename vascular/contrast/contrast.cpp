#include "vascular/contrast/contrast.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace ostium {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double thickest_kg_m3 = 400;  // beyond it a cell has lost volume: what is too much is pushed upstream
constexpr double least_m3 = 1e-13;
constexpr double traces_kg = 1e-16;  // of a cell: no one sees them, and they cost time

std::array<double, layers> poiseuille_shares() {
  std::array<double, layers> share;
  for (int k = 0; k < layers; ++k) {
    const auto section = [](double q) { return 1 - std::sqrt(1 - q); };
    share[k] = section((k + 1.0) / layers) - section(static_cast<double>(k) / layers);
  }
  return share;
}

void set_mixing(const FlowModel& flow, ContrastModel& model) {
  const FlowTree& tree = flow.tree;
  model.mixes.assign(tree.cells.size(), 0);
  for (const FlowBranch& b : tree.branches) {
    if (b.parent_cell < 0) continue;
    const FlowBranch& parent = tree.branches[b.parent];
    const double reach = tree.cells[b.first].healthy_m, at = tree.cells[b.parent_cell].s_m;
    for (int c = parent.first; c < parent.last; ++c)
      if (std::fabs(tree.cells[c].s_m - at) <= reach) model.mixes[c] = 1;
  }
}

/// The line holds what was pushed or drawn into it; `mass` lists it from where it enters. Returns what leaves it.
double push(double volume_m3, double entering_kg_m3, double dead_m3, ContrastScratch& x) {
  x.volume.assign(line_cells, dead_m3 / line_cells), x.passing.assign(line_cells + 1, volume_m3);
  x.through.resize(line_cells + 1);
  carry(x.mass, x.volume, x.passing, entering_kg_m3, x.through, x.carry);
  for (int i = 0; i < line_cells; ++i) x.mass[i] += x.through[i] - x.through[i + 1];
  return x.through[line_cells];
}

double push_line(const ContrastInputs& in, double volume_m3, ContrastState& s, ContrastScratch& x) {
  x.mass.assign(s.line_kg.begin(), s.line_kg.end());
  const double out = push(volume_m3, in.iodine_kg_m3, in.line.dead_m3, x);
  std::copy(x.mass.begin(), x.mass.end(), s.line_kg.begin());
  s.injected_kg += in.iodine_kg_m3 * volume_m3, s.injected_m3 += volume_m3;
  s.from_tip_kg += out;
  return out;
}

/// Returns what it took from where the tip is.
double draw_line(double volume_m3, double dead_m3, double tip_kg_m3, ContrastState& s, ContrastScratch& x) {
  x.mass.assign(s.line_kg.rbegin(), s.line_kg.rend());
  s.aspirated_kg += push(volume_m3, tip_kg_m3, dead_m3, x);
  std::copy(x.mass.rbegin(), x.mass.rend(), s.line_kg.begin());
  return tip_kg_m3 * volume_m3;
}

/// Poiseuille, round a shaft where there is one.
double fastest_m3_s(const Line& line, double shaft_m) {
  const double r2 = line.bore_m * line.bore_m, a = std::min(shaft_m, 0.98 * line.bore_m), a2 = a * a;
  const double fourth = a > 0 ? r2 * r2 - a2 * a2 - (r2 - a2) * (r2 - a2) / std::log(line.bore_m / a) : r2 * r2;
  return line.hand_Pa * pi * fourth / (8 * line.viscosity_Pa_s * line.length_m);
}

}  // namespace

ContrastModel make_contrast_model(const FlowModel& flow) {
  ContrastModel model{.share = poiseuille_shares(), .aorta_length_m = {0.01}, .aorta_radius_m = {0.015}, .mixes = {}};
  model.coronary_branch = {-1, -1};
  for (std::size_t b = 0, root = 0; b < flow.tree.branches.size() && root < 2; ++b)
    if (flow.tree.branches[b].parent < 0) model.coronary_branch[root++] = static_cast<int>(b);
  set_mixing(flow, model);
  return model;
}

ContrastModel make_contrast_model(const FlowModel& flow, const Patient& patient) {
  ContrastModel model = make_contrast_model(flow);
  model.aorta_length_m.clear(), model.aorta_radius_m.clear();
  model.coronary_branch = {flow.tree.branch("LM"), flow.tree.branch("RCA")};
  const auto& branches = patient.tree.branches;
  for (std::size_t t = 0; t < branches.size(); ++t) {
    if (branches[t].name != "aorta") continue;
    const auto& spheres = branches[t].spheres;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const double below = i ? spheres[i].s_m - spheres[i - 1].s_m : 0;
      const double above = i + 1 < spheres.size() ? spheres[i + 1].s_m - spheres[i].s_m : 0;
      model.aorta_length_m.push_back((below + above) / 2);
      model.aorta_radius_m.push_back(spheres[i].radius_m);
    }
    for (const TreeBranch& b : branches)
      if (b.parent == static_cast<int>(t) && (b.name == "LM" || b.name == "RCA"))
        model.ostium_cell[b.name == "LM" ? 0 : 1] = b.parent_sphere;
  }
  return model;
}

ContrastState make_contrast_state(const ContrastModel& model, const FlowModel& flow) {
  ContrastState s;
  s.line_kg.assign(line_cells, 0);
  s.sheath_kg.assign(layers * flow.tree.cells.size(), 0);
  s.aorta_kg.assign(model.aorta_length_m.size(), 0);
  return s;
}

double concentration(const ContrastState& s, const FlowModel& flow, int cell, double area_m2) {
  const std::size_t n = flow.tree.cells.size();
  double sum = 0;
  for (std::size_t k = 0; k < layers; ++k) sum += s.sheath_kg[k * n + static_cast<std::size_t>(cell)];
  return sum / std::max(area_m2 * flow.tree.cells[cell].length_m, least_m3);
}

double aorta_concentration(const ContrastModel& model, const ContrastState& s, int cell) {
  return s.aorta_kg[cell] / (pi * model.aorta_radius_m[cell] * model.aorta_radius_m[cell] * model.aorta_length_m[cell]);
}

double accounted_kg(const ContrastState& s) {
  double sum = s.aspirated_kg + s.muscle_kg + s.carried_kg + s.outside_kg + s.sinus_kg[0] + s.sinus_kg[1];
  for (const auto* part : {&s.line_kg, &s.sheath_kg, &s.aorta_kg})
    for (double m : *part) sum += m;
  return sum;
}

namespace {

/// One step of the whole: its parts in the order in which contrast meets them.
struct Step {
  const ContrastModel& model;
  const FlowModel& flow;
  const FlowState& blood;
  const FlowInputs& lumen;
  const ContrastInputs& in;
  double dt;
  ContrastState& s;
  ContrastScratch& x;
  ContrastReport report{};
  double mixing_now = -std::expm1(-dt / model.mixing_s);

  std::size_t n() const { return flow.tree.cells.size(); }
  double volume(int c) const { return x.cell_m3[c]; }
  void measure() {
    x.cell_m3.resize(n());
    for (std::size_t c = 0; c < n(); ++c) {
      const double occupied = lumen.occupied_m.empty() ? 0 : lumen.occupied_m[c];
      x.cell_m3[c] = std::max(least_m3, flow.tree.cells[c].length_m * free_area_m2(lumen.radius_m[c], occupied));
    }
  }
  int root(int side) const {
    const int b = model.coronary_branch[side];
    return b < 0 ? -1 : flow.tree.branches[b].first;
  }
  /// Volume that passes a cell's upstream face in this step, but for what a catheter adds there.
  double through(int c) const { return std::max(0.0, blood.flow_m3_s[c] * dt - x.entering[c]); }
  double sinus_kg_m3(int side) const { return s.sinus_kg[side] / model.sinus_m3; }

  /// What the catheter gives, to the coronary (x.entering, m3 and kg) and beside it.
  void inject() {
    x.entering.assign(2 * n(), 0);  // at each cell's upstream face: m3, then kg
    double rate = in.injection_m3_s;
    if (!(rate >= 0) || !std::isfinite(rate) || !(in.iodine_kg_m3 >= 0)) rate = 0, report.refused = true;
    report.rate_m3_s = rate = std::min(rate, fastest_m3_s(in.line, in.shaft_m));
    if (in.aspiration_m3_s > 0 && rate == 0) return aspirate();
    if (rate == 0) return;
    const double kg = push_line(in, rate * dt, s, x);
    double taken = 0;  // share
    int cell = -1;
    switch (in.tip.where) {
      case TipPlace::coronary:
        cell = in.tip.cell;
        taken = std::min(1.0, std::max(0.0, blood.flow_m3_s[cell]) / rate);
        break;
      case TipPlace::left_sinus:
      case TipPlace::right_sinus:
        cell = root(in.tip.where == TipPlace::right_sinus);
        if (cell < 0) break;
        taken = std::min(std::clamp(in.tip.into_ostium, 0.0, 1.0), std::max(0.0, blood.flow_m3_s[cell]) / rate);
        break;
      case TipPlace::aorta:
        s.aorta_kg[in.tip.cell] += kg;
        return;
      case TipPlace::outside:
        s.carried_kg += kg;
        return;
    }
    report.selective = taken;
    // What it gives need not come from ahead: less blood runs from the ostium to the tip.
    if (cell >= 0) x.entering[n() + cell] = taken * kg;
    int top = cell;
    for (int c = cell; c >= 0; c = flow.tree.cells[c].upstream) x.entering[c] = taken * rate * dt, top = c;
    // The rest spills into the root.
    const int side = in.tip.where == TipPlace::right_sinus || (top >= 0 && top == root(1)) ? 1 : 0;
    s.sinus_kg[side] += (1 - taken) * kg;
  }

  void aspirate() {
    const double wanted = in.aspiration_m3_s * dt;
    double there = 0, *from = nullptr;
    switch (in.tip.where) {
      case TipPlace::coronary: {
        // Out of all sheaths alike.
        double all = 0;
        for (int k = 0; k < layers; ++k) all += s.sheath_kg[k * n() + in.tip.cell];
        const double kg = draw_line(wanted, in.line.dead_m3, all / std::max(volume(in.tip.cell), wanted), s, x);
        for (int k = 0; k < layers && all > 0; ++k) s.sheath_kg[k * n() + in.tip.cell] *= 1 - kg / all;
        return;
      }
      case TipPlace::left_sinus:
      case TipPlace::right_sinus:
        from = &s.sinus_kg[in.tip.where == TipPlace::right_sinus];
        there = *from / model.sinus_m3;
        break;
      case TipPlace::aorta:
        from = &s.aorta_kg[in.tip.cell];
        there = aorta_concentration(model, s, in.tip.cell);
        break;
      case TipPlace::outside:
        break;
    }
    const double kg = draw_line(wanted, in.line.dead_m3, there, s, x);
    if (from) *from -= kg;
  }

  /// A balloon that fills a cell pushes out what was in it, towards the heart.
  void push_out_excess() {
    for (int c = static_cast<int>(n()) - 1; c >= 0; --c) {
      const int up = flow.tree.cells[c].upstream;
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

  void run_branch(int b) {
    const FlowTree& tree = flow.tree;
    const FlowBranch& branch = tree.branches[b];
    const int first = branch.first, cells = branch.cells();
    // What comes in from ahead: from the parent as it left it, at the ostium from the sinus.
    const double coming = through(first);
    double inlet_kg_m3;
    if (branch.parent >= 0) {
      inlet_kg_m3 = coming > 0 ? x.inlet[b] / coming : 0;
    } else {
      const int side = b == model.coronary_branch[1];
      inlet_kg_m3 = sinus_kg_m3(side);
      s.sinus_kg[side] -= inlet_kg_m3 * coming;
    }
    // A tip in the first cell gives to what comes in there, so that it is mixed before it goes on.
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

  /// Sheaths mix, side branches and muscle take theirs.
  void leave(int c) {
    double all = 0;
    for (int k = 0; k < layers; ++k) all += s.sheath_kg[k * n() + c];
    if (all < traces_kg) {
      s.muscle_kg += all;
      for (int k = 0; k < layers; ++k) s.sheath_kg[k * n() + c] = 0;
      return;
    }
    const double mixing = std::max(model.mixes[c], mixing_now), V = volume(c);
    const double leak = std::max(0.0, blood.leak_m3_s[c]) * dt / layers;
    double sides = 0;
    const FlowTree& tree = flow.tree;
    for (int j = tree.side_first[c]; j < tree.side_first[c + 1]; ++j)
      sides += through(tree.branches[tree.sides[j]].first) / layers;
    for (int k = 0; k < layers; ++k) {
      double& m = s.sheath_kg[k * n() + c];
      const double with_leaving = model.share[k] * V + leak + sides;
      m += mixing * (with_leaving / (V + layers * (leak + sides)) * all - m);
      const double kg_m3 = m / with_leaving;
      s.muscle_kg += kg_m3 * leak;
      for (int j = tree.side_first[c]; j < tree.side_first[c + 1]; ++j) {
        const int child = tree.sides[j];
        x.inlet[child] += kg_m3 * through(tree.branches[child].first) / layers;
      }
      m -= kg_m3 * (leak + sides);
    }
  }

  /// The beat's to and fro, between neighbours of a branch.
  void disperse() {
    for (const FlowBranch& branch : flow.tree.branches)
      for (int c = branch.first; c + 1 < branch.last; ++c) {
        if (s.sheath_kg[c] == 0 && s.sheath_kg[c + 1] == 0) continue;  // the fastest sheath is ahead of the others
        const FlowCell &a = flow.tree.cells[c], &b = flow.tree.cells[c + 1];
        const double Va = volume(c), Vb = volume(c + 1), apart = (a.length_m + b.length_m) / 2;
        const double exchanged = std::min(
            model.dispersion_m2_s * dt / apart * std::min(Va / a.length_m, Vb / b.length_m), 0.2 * std::min(Va, Vb));
        for (int k = 0; k < layers; ++k) {
          double &ma = s.sheath_kg[k * n() + c], &mb = s.sheath_kg[k * n() + c + 1];
          const double kg = exchanged * (ma / Va - mb / Vb);
          ma -= kg, mb += kg;
        }
      }
  }

  void run_aorta(double ejection_m3_s) {
    const int cells = static_cast<int>(s.aorta_kg.size());
    for (int side = 0; side < 2; ++side) {
      const int at = std::min(model.ostium_cell[side], cells - 1);
      const double c_root = aorta_concentration(model, s, at);
      const double exchanged =
          std::min(0.5 * model.sinus_m3, (model.sinus_flow_m3_s + model.sinus_share * std::fabs(ejection_m3_s)) * dt);
      const double drawn = root(side) < 0 ? 0 : std::max(0.0, blood.flow_m3_s[root(side)]) * dt;
      const double kg = exchanged * (sinus_kg_m3(side) - c_root) - drawn * c_root;
      s.sinus_kg[side] -= kg, s.aorta_kg[at] += kg;
    }
    x.volume.resize(cells), x.through.resize(cells + 1);
    for (int i = 0; i < cells; ++i)
      x.volume[i] = pi * model.aorta_radius_m[i] * model.aorta_radius_m[i] * model.aorta_length_m[i];
    x.mass.assign(s.aorta_kg.begin(), s.aorta_kg.end());
    x.passing.assign(cells + 1, std::max(0.0, ejection_m3_s) * dt);
    carry(x.mass, x.volume, x.passing, 0, x.through, x.carry);
    for (int i = 0; i < cells; ++i) s.aorta_kg[i] += x.through[i] - x.through[i + 1];
    s.carried_kg += x.through[cells];
  }
};

}  // namespace

ContrastReport step(const ContrastModel& model, const FlowModel& flow, const FlowState& blood, const FlowInputs& lumen,
                    double ejection_m3_s, const ContrastInputs& inputs, double dt_s, ContrastState& state,
                    ContrastScratch& scratch) {
  Step run{model, flow, blood, lumen, inputs, dt_s, state, scratch};
  scratch.inlet.assign(flow.tree.branches.size(), 0);
  run.measure();
  run.inject();
  run.push_out_excess();
  for (std::size_t b = 0; b < flow.tree.branches.size(); ++b) run.run_branch(static_cast<int>(b));
  run.disperse();
  run.run_aorta(ejection_m3_s);
  return run.report;
}

}  // namespace ostium
