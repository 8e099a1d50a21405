#include "vascular/contrast/lumen_map.h"

#include <algorithm>
#include <utility>

namespace ostium {

namespace {

/// Cells of one part by arc length of a tube.
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
    if (tube == aorta_tube) return s <= aorta.s_m.back() ? aorta.at(s, VertexSource::aorta) : VertexSource{};
    if (name == "left sinus" || name == "right sinus" || name == "non-coronary sinus") {
      const double along = nearest_s(anatomy.tubes[aorta_tube], anatomy.tubes[tube].at(s).p);
      return aorta.at(along, name == "left sinus"    ? VertexSource::left_sinus
                             : name == "right sinus" ? VertexSource::right_sinus
                                                     : VertexSource::aorta);
    }
    return {};
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
  return map;
}

void opacify(const LumenMap& map, const FlowModel& flow, const FlowInputs& lumen, const ContrastModel& model,
             const ContrastState& state, double phase, std::span<float> iodine_kg_m3,
             Eigen::Ref<Eigen::Matrix3Xf> centres, OpacityScratch& scratch) {
  // Cell by cell once, then vertices.
  auto& [coronary, aorta, coronary_p, aorta_p] = scratch;
  const std::size_t n = flow.tree.cells.size(), m = state.aorta_kg.size();
  coronary.resize(n), aorta.resize(m), coronary_p.resize(3, static_cast<int>(n)),
      aorta_p.resize(3, static_cast<int>(m));
  for (std::size_t c = 0; c < n; ++c) {
    const double area = free_area_m2(lumen.radius_m[c], lumen.occupied_m.empty() ? 0 : lumen.occupied_m[c]);
    coronary[c] = static_cast<float>(concentration(state, flow, static_cast<int>(c), area));
    coronary_p.col(static_cast<int>(c)) = map.coronary.position(c, phase).cast<float>();
  }
  for (std::size_t c = 0; c < m; ++c) {
    aorta[c] = static_cast<float>(aorta_concentration(model, state, static_cast<int>(c)));
    aorta_p.col(static_cast<int>(c)) = map.aorta.position(c, phase).cast<float>();
  }
  for (std::size_t c = 0; c < n; ++c) {
    const auto [parent, share] = map.parent_centre[c];
    if (share > 0) {
      const Eigen::Vector3f own = coronary_p.col(static_cast<int>(c));
      coronary_p.col(static_cast<int>(c)) = (1 - share) * own + share * coronary_p.col(parent);
    }
  }
  const auto add = [&](const VertexSource& from, float weight, float& sum, Eigen::Vector3f& moment) {
    if (from.part == VertexSource::none) return;
    const bool is_coronary = from.part == VertexSource::coronary;
    const Eigen::Matrix3Xf& p = is_coronary ? coronary_p : aorta_p;
    const std::vector<float>& c = is_coronary ? coronary : aorta;
    float iodine = (1 - from.share) * c[from.below] + from.share * c[from.above];
    if (from.part == VertexSource::left_sinus || from.part == VertexSource::right_sinus)
      iodine = static_cast<float>(state.sinus_kg[from.part == VertexSource::right_sinus] / model.sinus_m3);
    // A vertex without iodine needs a centre too: of those, any weight does.
    const float counts = weight * std::max(iodine, 1e-6F);
    sum += counts;
    moment += counts * ((1 - from.share) * p.col(from.below) + from.share * p.col(from.above));
  };
  for (std::size_t v = 0; v < map.sources.size(); ++v) {
    const LumenMap::Vertex& from = map.sources[v];
    float sum = 0;
    Eigen::Vector3f moment = Eigen::Vector3f::Zero();
    add(from.first, 1 - from.second_share, sum, moment);
    if (from.second_share > 0) add(from.second, from.second_share, sum, moment);
    iodine_kg_m3[v] = sum;
    centres.col(static_cast<int>(v)) = sum > 0 ? Eigen::Vector3f(moment / sum) : Eigen::Vector3f::Zero();
  }
}

}  // namespace ostium
