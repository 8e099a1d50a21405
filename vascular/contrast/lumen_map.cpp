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

void opacify(const LumenMap& map, const FlowModel& flow, const FlowInputs& lumen, const ContrastModel& model,
             const ContrastState& state, double phase, double breath, std::span<float> iodine_kg_m3,
             Eigen::Ref<Eigen::Matrix3Xf> centres, Eigen::Ref<Eigen::Matrix3Xf> along, OpacityScratch& scratch) {
  // Cell by cell once, then vertices.
  auto& [coronary, aorta, coronary_p, aorta_p, coronary_along, aorta_along] = scratch;
  const std::size_t n = flow.tree.cells.size(), m = state.aorta_kg.size();
  coronary.resize(n), aorta.resize(m), coronary_p.resize(3, static_cast<int>(n)),
      aorta_p.resize(3, static_cast<int>(m));
  for (std::size_t c = 0; c < n; ++c) {
    const double area = free_area_m2(lumen.radius_m[c], lumen.occupied_m.empty() ? 0 : lumen.occupied_m[c]);
    coronary[c] = static_cast<float>(concentration(state, flow, static_cast<int>(c), area));
    coronary_p.col(static_cast<int>(c)) = map.centre(c, phase, breath).cast<float>();
  }
  for (std::size_t c = 0; c < m; ++c) {
    aorta[c] = static_cast<float>(aorta_concentration(model, state, static_cast<int>(c)));
    aorta_p.col(static_cast<int>(c)) = map.aorta_centre(c, phase, breath).cast<float>();
  }
  for (std::size_t c = 0; c < n; ++c) {
    const auto [parent, share] = map.parent_centre[c];
    if (share > 0) {
      const Eigen::Vector3f own = coronary_p.col(static_cast<int>(c));
      coronary_p.col(static_cast<int>(c)) = (1 - share) * own + share * coronary_p.col(parent);
    }
  }
  // What is counted along the centrelines: from the aorta's first cell on, into each artery from where it begins.
  aorta_along.resize(3, static_cast<int>(m)), coronary_along.resize(3, static_cast<int>(n));
  aorta_along.col(0).setZero();
  for (int c = 1; c < static_cast<int>(m); ++c)
    aorta_along.col(c) = aorta_along.col(c - 1) + (aorta[c] + aorta[c - 1]) / 2 * (aorta_p.col(c) - aorta_p.col(c - 1));
  const auto in_sinus = [&](int side, const Eigen::Vector3f& p) {
    const int at = std::min(model.ostium_cell[side], static_cast<int>(m) - 1);
    const auto c = static_cast<float>(state.sinus_kg[side] / model.sinus_m3);
    return Eigen::Vector3f(aorta_along.col(at) + c * (p - aorta_p.col(at)));
  };
  for (int c = 0; c < static_cast<int>(n); ++c) {
    const FlowCell& cell = flow.tree.cells[c];
    if (cell.upstream < 0) {
      coronary_along.col(c) = in_sinus(cell.branch == model.coronary_branch[1], coronary_p.col(c));
      continue;
    }
    const float mean = (coronary[c] + coronary[cell.upstream]) / 2;
    coronary_along.col(c) =
        coronary_along.col(cell.upstream) + mean * (coronary_p.col(c) - coronary_p.col(cell.upstream));
  }
  struct Sum {
    float iodine = 0;
    Eigen::Vector3f moment = Eigen::Vector3f::Zero(), along = Eigen::Vector3f::Zero();
  };
  const auto add = [&](const VertexSource& from, float weight, Sum& sum) {
    const bool is_coronary = from.part == VertexSource::coronary;
    const Eigen::Matrix3Xf& p = is_coronary ? coronary_p : aorta_p;
    const Eigen::Matrix3Xf& counted = is_coronary ? coronary_along : aorta_along;
    const std::vector<float>& c = is_coronary ? coronary : aorta;
    const Eigen::Vector3f centre = (1 - from.share) * p.col(from.below) + from.share * p.col(from.above);
    Eigen::Vector3f so_far = (1 - from.share) * counted.col(from.below) + from.share * counted.col(from.above);
    float iodine = (1 - from.share) * c[from.below] + from.share * c[from.above];
    if (from.part == VertexSource::none) iodine = 0;
    if (from.part == VertexSource::left_sinus || from.part == VertexSource::right_sinus) {
      const int side = from.part == VertexSource::right_sinus;
      iodine = static_cast<float>(state.sinus_kg[side] / model.sinus_m3);
      so_far = in_sinus(side, centre);
    }
    // A vertex without iodine needs a centre too: of those, any weight does.
    const float counts = weight * std::max(iodine, 1e-6F);
    sum.iodine += counts;
    sum.moment += counts * centre;
    sum.along += weight * so_far;
  };
  for (std::size_t v = 0; v < map.sources.size(); ++v) {
    const LumenMap::Vertex& from = map.sources[v];
    Sum sum;
    add(from.first, 1 - from.second_share, sum);
    if (from.second_share > 0) add(from.second, from.second_share, sum);
    iodine_kg_m3[v] = sum.iodine;
    centres.col(static_cast<int>(v)) = sum.moment / sum.iodine;
    along.col(static_cast<int>(v)) = sum.along;
  }
}

}  // namespace ostium
