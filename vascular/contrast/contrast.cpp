#include "vascular/contrast/contrast.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "vascular/contrast/contrast_step.h"

namespace ostium::vascular {

namespace {

using units::pi;

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
  model.coronary_branch = {flow.tree.branch("LM"), flow.tree.branch("RCA")};
  const auto& branches = patient.tree.branches;
  for (std::size_t t = 0; t < branches.size(); ++t) {
    if (branches[t].name != "aorta") continue;
    const auto& spheres = branches[t].spheres;
    model.aorta_length_m.clear(), model.aorta_radius_m.clear();  // without an aorta they are one cell
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

void fill_tree(const ContrastModel& model, const FlowModel& flow, int side, double iodine_kg_m3,
               std::span<const double> radius_m, std::span<const double> occupied_m, ContrastState& s) {
  const int trunk = model.coronary_branch[static_cast<std::size_t>(side)];
  if (trunk < 0) return;
  const std::size_t n = flow.tree.cells.size();
  const int first = flow.tree.branches[static_cast<std::size_t>(trunk)].first;
  for (std::size_t c = 0; c < n; ++c) {
    if (!flow.tree.is_downstream(static_cast<int>(c), first)) continue;
    const double area_m2 = free_area_m2(radius_m[c], occupied_m.empty() ? 0 : occupied_m[c]);
    for (std::size_t k = 0; k < layers; ++k)
      s.sheath_kg[k * n + c] =
          model.share[k] * iodine_kg_m3 * std::max(area_m2 * flow.tree.cells[c].length_m, least_m3);
  }
}

double aorta_concentration(const ContrastModel& model, const ContrastState& s, int cell) {
  return s.aorta_kg[cell] / (pi * model.aorta_radius_m[cell] * model.aorta_radius_m[cell] * model.aorta_length_m[cell]);
}

double accounted_kg(const ContrastState& s) {
  double sum =
      s.aspirated_kg + s.muscle_kg[0] + s.muscle_kg[1] + s.carried_kg + s.outside_kg + s.sinus_kg[0] + s.sinus_kg[1];
  for (const auto* part : {&s.line_kg, &s.sheath_kg, &s.aorta_kg})
    for (double m : *part) sum += m;
  return sum;
}

}  // namespace ostium::vascular
