#include "app/angiography/patient_scene.h"

#include "fluoro/tissue.h"
#include "vascular/beat/heart_cycle.h"

namespace ostium {

namespace {

Tissue tissue_of(BodyTissue tissue) {
  switch (tissue) {
    case BodyTissue::air:
      return tissue::air;
    case BodyTissue::soft_tissue:
      return tissue::soft;
    case BodyTissue::lung:
      return tissue::lung;
    case BodyTissue::blood:
      return tissue::blood;
    case BodyTissue::cortical_bone:
      return tissue::cortical_bone;
    case BodyTissue::spongy_bone:
      return tissue::spongy_bone;
  }
  return tissue::soft;
}

std::shared_ptr<const Triangles> triangles_of(const std::vector<std::array<int, 3>>& triangles) {
  auto out = std::make_shared<Triangles>(3, triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) (*out)(k, static_cast<Eigen::Index>(t)) = triangles[t][static_cast<std::size_t>(k)];
  return out;
}

Eigen::Matrix3Xf points_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Matrix3Xf out(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) out.col(static_cast<Eigen::Index>(i)) = points[i].cast<float>();
  return out;
}

Body body_of(const XrayBody& from) {
  return {.name = from.name,
          .triangles = triangles_of(from.mesh.triangles),
          .p_P = points_of(from.mesh.vertices),
          .tissue = tissue_of(from.tissue),
          .within = tissue_of(from.within),
          .contrast = {}};
}

}  // namespace

PatientScene::PatientScene(const Patient& patient, const PhysiologyModel& physiology)
    : patient_(patient),
      physiology_(physiology),
      map_(make_lumen_map(patient, physiology.flow)),
      shape_(patient, map_, physiology.flow.tree) {
  std::vector<Body> still;
  for (XrayBody& body : make_thorax(patient.anatomy)) {
    if (body.beat.empty() && body.breath.empty()) {
      still.push_back(body_of(body));
    } else {
      scene_.moving.push_back(body_of(body));
      thorax_.push_back(std::move(body));
    }
  }
  scene_.fixed = std::make_shared<const std::vector<Body>>(std::move(still));
  const auto n = static_cast<Eigen::Index>(patient.lumen.vertices());
  Body lumen{.name = "lumen",
             .triangles = triangles_of(patient.lumen.triangles),
             .p_P = Eigen::Matrix3Xf(3, n),
             .tissue = tissue::blood,
             .within = tissue::soft,
             .contrast = {}};
  lumen.contrast.iodine_kg_m3 = Eigen::VectorXf::Zero(n);
  lumen.contrast.p_PC = lumen.contrast.along_kg_m2 = Eigen::Matrix3Xf::Zero(3, n);
  scene_.moving.push_back(std::move(lumen));
  own_ = scene_.moving.size();
}

const Scene& PatientScene::at(const PhysiologyState& state, std::span<const double> occupied_m, double breath) {
  const double phase = state.heart.phase;
  scene_.moving.resize(own_);
  scene_.shafts.clear();
  for (std::size_t b = 0; b < thorax_.size(); ++b)
    scene_.moving[b].p_P = points_of(ostium::at(thorax_[b], contraction(phase), breath).vertices);
  Body& lumen = scene_.moving[thorax_.size()];
  shape_.at(state.radius_m, phase, breath, vertices_);
  lumen.p_P = points_of(vertices_);
  const FlowInputs in{{}, state.radius_m, occupied_m, 0};
  opacify(map_, physiology_.flow, in, physiology_.contrast, state.contrast, phase,
          {lumen.contrast.iodine_kg_m3.data(), static_cast<std::size_t>(lumen.contrast.iodine_kg_m3.size())},
          lumen.contrast.p_PC, lumen.contrast.along_kg_m2, scratch_);
  return scene_;
}

}  // namespace ostium
