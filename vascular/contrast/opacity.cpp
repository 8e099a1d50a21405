#include "vascular/contrast/opacity.h"

#include <algorithm>

namespace ostium::vascular {

namespace {

/// Concentration and centre of each cell.
void measure_cells(const LumenMap& map, const OpacityInputs& in, OpacityScratch& x) {
  std::vector<float>&coronary = x.coronary, &aorta = x.aorta;
  Eigen::Matrix3Xf &coronary_p = x.coronary_p, &aorta_p = x.aorta_p;
  const std::size_t n = in.flow.tree.cells.size(), m = in.state.aorta_kg.size();
  coronary.resize(n), aorta.resize(m), coronary_p.resize(3, static_cast<int>(n)),
      aorta_p.resize(3, static_cast<int>(m));
  for (std::size_t c = 0; c < n; ++c) {
    const double area = free_area_m2(in.lumen.radius_m[c], in.lumen.occupied_m.empty() ? 0 : in.lumen.occupied_m[c]);
    coronary[c] = static_cast<float>(concentration(in.state, in.flow, static_cast<int>(c), area));
    coronary_p.col(static_cast<int>(c)) = map.centre(c, in.moment).cast<float>();
  }
  for (std::size_t c = 0; c < m; ++c) {
    aorta[c] = static_cast<float>(aorta_concentration(in.model, in.state, static_cast<int>(c)));
    aorta_p.col(static_cast<int>(c)) = map.aorta_centre(c, in.moment).cast<float>();
  }
  for (std::size_t c = 0; c < n; ++c) {
    const auto [parent, share] = map.parent_centre[c];
    if (share > 0) {
      const Eigen::Vector3f own = coronary_p.col(static_cast<int>(c));
      coronary_p.col(static_cast<int>(c)) = (1 - share) * own + share * coronary_p.col(parent);
    }
  }
}

/// The integral from the aorta's first cell to a point in a sinus.
Eigen::Vector3f along_in_sinus(const OpacityInputs& in, const OpacityScratch& x, int side, const Eigen::Vector3f& p) {
  const int at = std::min(in.model.ostium_cell[side], static_cast<int>(x.aorta.size()) - 1);
  const auto c = static_cast<float>(in.state.sinus_kg[side] / in.model.sinus_m3);
  return Eigen::Vector3f(x.aorta_along.col(at) + c * (p - x.aorta_p.col(at)));
}

/// The integral along the centrelines: from the aorta's first cell, into each artery at its origin.
void integrate_along(const OpacityInputs& in, OpacityScratch& x) {
  auto& [coronary, aorta, coronary_p, aorta_p, coronary_along, aorta_along] = x;
  const int n = static_cast<int>(coronary.size()), m = static_cast<int>(aorta.size());
  aorta_along.resize(3, m), coronary_along.resize(3, n);
  aorta_along.col(0).setZero();
  for (int c = 1; c < m; ++c)
    aorta_along.col(c) = aorta_along.col(c - 1) + (aorta[c] + aorta[c - 1]) / 2 * (aorta_p.col(c) - aorta_p.col(c - 1));
  for (int c = 0; c < n; ++c) {
    const FlowCell& cell = in.flow.tree.cells[c];
    if (cell.upstream < 0) {
      coronary_along.col(c) = along_in_sinus(in, x, cell.branch == in.model.coronary_branch[1], coronary_p.col(c));
      continue;
    }
    const float mean = (coronary[c] + coronary[cell.upstream]) / 2;
    coronary_along.col(c) =
        coronary_along.col(cell.upstream) + mean * (coronary_p.col(c) - coronary_p.col(cell.upstream));
  }
}

/// Weighted sum over a vertex's sources.
struct Sum {
  float iodine = 0;
  Eigen::Vector3f moment = Eigen::Vector3f::Zero(), along = Eigen::Vector3f::Zero();
};

void add(const OpacityInputs& in, const OpacityScratch& x, const VertexSource& from, float weight, Sum& sum) {
  const bool is_coronary = from.part == VertexSource::coronary;
  const Eigen::Matrix3Xf& p = is_coronary ? x.coronary_p : x.aorta_p;
  const Eigen::Matrix3Xf& counted = is_coronary ? x.coronary_along : x.aorta_along;
  const std::vector<float>& c = is_coronary ? x.coronary : x.aorta;
  const Eigen::Vector3f centre = (1 - from.share) * p.col(from.below) + from.share * p.col(from.above);
  Eigen::Vector3f so_far = (1 - from.share) * counted.col(from.below) + from.share * counted.col(from.above);
  float iodine = (1 - from.share) * c[from.below] + from.share * c[from.above];
  if (from.part == VertexSource::none) iodine = 0;
  if (from.part == VertexSource::left_sinus || from.part == VertexSource::right_sinus) {
    const int side = from.part == VertexSource::right_sinus;
    iodine = static_cast<float>(in.state.sinus_kg[side] / in.model.sinus_m3);
    so_far = along_in_sinus(in, x, side, centre);
  }
  // A vertex without iodine needs a centre as well; for those any weight will do.
  const float counts = weight * std::max(iodine, 1e-6F);
  sum.iodine += counts;
  sum.moment += counts * centre;
  sum.along += weight * so_far;
}

float densest(const OpacityInputs& in, const OpacityScratch& x) {
  float most = 0;
  for (const std::vector<float>* cells : {&x.coronary, &x.aorta})
    for (float kg_m3 : *cells) most = std::max(most, kg_m3);
  for (double kg : in.state.sinus_kg) most = std::max(most, static_cast<float>(kg / in.model.sinus_m3));
  return most;
}

}  // namespace

void opacify(const LumenMap& map, const OpacityInputs& in, Opacity out, OpacityScratch& x) {
  measure_cells(map, in, x);
  if (densest(in, x) <= in.faintest_kg_m3) {
    std::fill(out.iodine_kg_m3.begin(), out.iodine_kg_m3.end(), 0.0f);
    return;
  }
  integrate_along(in, x);
  for (std::size_t v = 0; v < map.sources.size(); ++v) {
    const LumenMap::Vertex& from = map.sources[v];
    Sum sum;
    add(in, x, from.first, 1 - from.second_share, sum);
    if (from.second_share > 0) add(in, x, from.second, from.second_share, sum);
    out.iodine_kg_m3[v] = sum.iodine;
    out.p.col(static_cast<int>(v)) = sum.moment / sum.iodine;
    out.along.col(static_cast<int>(v)) = sum.along;
  }
}

}  // namespace ostium::vascular
