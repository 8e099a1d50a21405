#include "vascular/contrast/lumen_map.h"

#include <algorithm>
#include <utility>

namespace ostium::vascular {

namespace {

/// Cells of one part, by arc length along a tube.
struct Row {
  std::vector<double> s_m;
  std::vector<int> cell;
  VertexSource at(double s, VertexSource::Part part) const {
    const auto above = std::upper_bound(s_m.begin(), s_m.end(), s) - s_m.begin();
    if (above == 0) return {part, cell.front(), cell.front(), 0};
    if (above == static_cast<std::ptrdiff_t>(s_m.size())) return {part, cell.back(), cell.back(), 0};
    const double share = (s - s_m[above - 1]) / (s_m[above] - s_m[above - 1]);
    return {part, cell[above - 1], cell[above], static_cast<float>(share)};
  }
};

PeriodicPoints centres_of(const Patient& patient, const std::vector<std::pair<int, int>>& spheres) {
  std::vector<std::vector<Eigen::Vector3d>> frames(beat_frames);
  for (int f = 0; f < beat_frames; ++f)
    for (const auto& [branch, sphere] : spheres)
      frames[f].push_back(patient.tree_frames[f].branches[branch].spheres[sphere].p);
  return PeriodicPoints(frames);
}

std::vector<Eigen::Vector3d> breath_of(const Patient& patient, const std::vector<std::pair<int, int>>& spheres) {
  std::vector<Eigen::Vector3d> breath;
  for (const auto& [branch, sphere] : spheres) breath.push_back(patient.tree_breath[branch][sphere]);
  return breath;
}

}  // namespace

LumenMap make_lumen_map(const Patient& patient, const FlowModel& flow) {
  const Anatomy& anatomy = patient.anatomy;
  std::vector<Row> rows(anatomy.tubes.size());
  std::vector<std::pair<int, int>> spheres, aorta_spheres;
  for (const FlowBranch& b : flow.tree.branches)
    for (int c = b.first; c < b.last; ++c) {
      rows[b.tube].s_m.push_back(b.from_m + flow.tree.cells[c].s_m - flow.tree.cells[b.first].s_m);
      rows[b.tube].cell.push_back(c);
      spheres.emplace_back(b.tree_branch, flow.tree.cells[c].sphere);
    }
  Row aorta;
  int aorta_tube = -1;
  for (std::size_t t = 0; t < patient.tree.branches.size(); ++t)
    if (patient.tree.branches[t].name == "aorta") {
      aorta_tube = anatomy.branches[t].tube;
      for (std::size_t i = 0; i < patient.tree.branches[t].spheres.size(); ++i) {
        aorta.s_m.push_back(patient.tree.branches[t].spheres[i].s_m), aorta.cell.push_back(static_cast<int>(i));
        aorta_spheres.emplace_back(t, i);
      }
    }
  const auto source = [&](int tube, double s) -> VertexSource {
    const std::string& name = anatomy.tubes[tube].name;
    if (!rows[tube].cell.empty()) return rows[tube].at(s, VertexSource::coronary);
    const int last = aorta.cell.back();
    if (tube == aorta_tube)
      return s <= aorta.s_m.back() ? aorta.at(s, VertexSource::aorta) : VertexSource{VertexSource::none, last, last, 0};
    if (name == "left sinus" || name == "right sinus" || name == "non-coronary sinus") {
      const double along = nearest_s(anatomy.tubes[aorta_tube], anatomy.tubes[tube].at(s).p);
      return aorta.at(along, name == "left sinus"    ? VertexSource::left_sinus
                             : name == "right sinus" ? VertexSource::right_sinus
                                                     : VertexSource::aorta);
    }
    int t = tube;
    while (t >= 0 && anatomy.tubes[t].parent != aorta_tube) t = anatomy.tubes[t].parent;
    if (t < 0) return {VertexSource::none, last, last, 0};
    VertexSource from =
        aorta.at(nearest_s(anatomy.tubes[aorta_tube], anatomy.tubes[t].nodes.front().p), VertexSource::none);
    return from;
  };
  LumenMap map;
  for (const auto& shares : patient.lumen.shares) {
    const TubeShare none{}, *first = &none, *second = &none;
    for (const TubeShare& share : shares)
      if (share.weight > first->weight)
        second = first, first = &share;
      else if (share.weight > second->weight)
        second = &share;
    LumenMap::Vertex& v = map.sources.emplace_back();
    if (first->weight > 0) v.first = source(first->tube, first->s_m);
    if (second->weight > 0.02) {
      v.second = source(second->tube, second->s_m);
      v.second_share = static_cast<float>(second->weight / (first->weight + second->weight));
    }
  }
  for (const FlowCell& cell : flow.tree.cells) {
    const FlowBranch& branch = flow.tree.branches[cell.branch];
    if (branch.parent_cell < 0) {
      map.parent_centre.emplace_back(0, 0.0F);
      continue;
    }
    const double reach = 1.5 * flow.tree.cells[branch.parent_cell].healthy_m;
    const double from = cell.s_m - flow.tree.cells[branch.first].s_m;
    map.parent_centre.emplace_back(branch.parent_cell, static_cast<float>(1 - smooth_step(0, reach, from)));
  }
  map.coronary = centres_of(patient, spheres);
  map.aorta = centres_of(patient, aorta_spheres);
  map.coronary_breath = breath_of(patient, spheres), map.aorta_breath = breath_of(patient, aorta_spheres);
  return map;
}

}  // namespace ostium::vascular
