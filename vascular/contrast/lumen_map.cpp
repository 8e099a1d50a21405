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
    const TubeShare* most = nullptr;
    for (const TubeShare& share : shares)
      if (!most || share.weight > most->weight) most = &share;
    map.sources.push_back(most ? source(most->tube, most->s_m) : VertexSource{});
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
  for (std::size_t v = 0; v < map.sources.size(); ++v) {
    const VertexSource& from = map.sources[v];
    const int i = static_cast<int>(v);
    if (from.part == VertexSource::none) {
      iodine_kg_m3[v] = 0, centres.col(i).setZero();
      continue;
    }
    const bool is_coronary = from.part == VertexSource::coronary;
    const Eigen::Matrix3Xf& p = is_coronary ? coronary_p : aorta_p;
    centres.col(i) = (1 - from.share) * p.col(from.below) + from.share * p.col(from.above);
    if (from.part == VertexSource::left_sinus || from.part == VertexSource::right_sinus)
      iodine_kg_m3[v] = static_cast<float>(state.sinus_kg[from.part == VertexSource::right_sinus] / model.sinus_m3);
    else {
      const std::vector<float>& c = is_coronary ? coronary : aorta;
      iodine_kg_m3[v] = (1 - from.share) * c[from.below] + from.share * c[from.above];
    }
  }
}

}  // namespace ostium
