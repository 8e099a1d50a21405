#include "app/angiography/lumen_body.h"

#include <map>

namespace ostium::app {

LumenBody::LumenBody(const vascular::Patient& patient, const vascular::LumenMap& map, const vascular::FlowModel& flow)
    : part_of_(patient.lumen.vertices()) {
  constexpr int aorta_cells = 8;  // of a stretch
  std::map<std::pair<int, int>, int> parts;
  for (std::size_t v = 0; v < part_of_.size(); ++v) {
    const vascular::VertexSource& from = map.sources[v].first;
    const int which = from.part == vascular::VertexSource::coronary
                          ? flow.tree.cells[static_cast<std::size_t>(from.below)].branch
                          : from.below / aorta_cells;
    part_of_[v] = parts.emplace(std::pair(int{from.part}, which), static_cast<int>(parts.size())).first->second;
  }
  filled_.assign(parts.size(), false);
  const auto n = static_cast<Eigen::Index>(part_of_.size());
  whole_.iodine_kg_m3 = Eigen::VectorXf::Zero(n);
  whole_.p_PC = whole_.along_kg_m2 = p_P_ = Eigen::Matrix3Xf::Zero(3, n);
}

vascular::Opacity LumenBody::opacity() {
  return {{whole_.iodine_kg_m3.data(), part_of_.size()}, whole_.p_PC, whole_.along_kg_m2};
}

void LumenBody::fill(const std::vector<Corners>& triangles) {
  std::vector<bool> filled(filled_.size(), false);
  for (std::size_t v = 0; v < part_of_.size(); ++v)
    if (whole_.iodine_kg_m3[static_cast<Eigen::Index>(v)] > fluoro::faintest_iodine_kg_m3)
      filled[static_cast<std::size_t>(part_of_[v])] = true;
  if (filled == filled_) return;
  filled_ = std::move(filled);
  // With one filled corner a triangle belongs to them: where they are cut off, there is no iodine.
  const auto has = [&](int v) { return filled_[static_cast<std::size_t>(part_of_[static_cast<std::size_t>(v)])]; };
  cut_ = cut_out(triangles, part_of_.size(), [&](const Corners& t) { return has(t[0]) || has(t[1]) || has(t[2]); });
}

fluoro::Body LumenBody::body() const {
  fluoro::Body out{.name = "lumen",
                   .triangles = cut_.triangles,
                   .p_P = {},
                   .tissue = {},  // a coronary artery of 3 mm differs from what is round it by half a percent
                   .within = {},
                   .contrast = {}};
  take(cut_, p_P_, out.p_P);
  take(cut_, whole_.p_PC, out.contrast.p_PC);
  take(cut_, whole_.along_kg_m2, out.contrast.along_kg_m2);
  Eigen::RowVectorXf iodine;
  take(cut_, whole_.iodine_kg_m3.transpose(), iodine);
  out.contrast.iodine_kg_m3 = iodine.transpose();
  return out;
}

}  // namespace ostium::app
