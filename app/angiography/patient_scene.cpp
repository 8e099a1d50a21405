#include "app/angiography/patient_scene.h"

#include "app/angiography/xray_body.h"
#include "fluoro/matter/tissue.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::app {

PatientScene::PatientScene(const vascular::Patient& patient, const vascular::PhysiologyModel& physiology, bool breathes)
    : patient_(patient),
      physiology_(physiology),
      map_(make_lumen_map(patient, physiology.flow)),
      shape_(patient, map_, physiology.flow.tree) {
  std::vector<fluoro::Body> still;
  std::vector<vascular::XrayBody> moving;
  for (vascular::XrayBody& body : make_thorax(patient.anatomy)) {
    if (body.beat.empty() && !(breathes && !body.breath.empty())) {
      still.push_back(body_of(body));
    } else {
      scene_.moving.push_back(body_of(body));
      moving.push_back(std::move(body));
    }
  }
  scene_.fixed = std::make_shared<const std::vector<fluoro::Body>>(std::move(still));
  thorax_ = std::make_shared<const std::vector<vascular::XrayBody>>(std::move(moving));
  const auto n = static_cast<Eigen::Index>(patient.lumen.vertices());
  fluoro::Body lumen{.name = "lumen",
                     .triangles = triangles_of(patient.lumen.triangles),
                     .p_P = Eigen::Matrix3Xf(3, n),
                     .tissue = fluoro::tissue::blood,
                     .within = fluoro::tissue::soft,
                     .contrast = {}};
  lumen.contrast.iodine_kg_m3 = Eigen::VectorXf::Zero(n);
  lumen.contrast.p_PC = lumen.contrast.along_kg_m2 = Eigen::Matrix3Xf::Zero(3, n);
  scene_.moving.push_back(std::move(lumen));
  twigs_ = std::make_shared<const vascular::Twigs>(grow_twigs(patient));
  scene_.moving.push_back(body_of(*twigs_));
  own_ = scene_.moving.size();
}

PatientScene::PatientScene(const PatientScene& same, const vascular::PhysiologyModel& physiology)
    : patient_(same.patient_),
      physiology_(physiology),
      map_(same.map_),
      shape_(patient_, map_, physiology.flow.tree),
      thorax_(same.thorax_),
      twigs_(same.twigs_),
      scene_(same.scene_),
      own_(same.own_) {
  scene_.moving.resize(own_);
  scene_.shafts.clear();
}

const fluoro::Scene& PatientScene::at(const vascular::PhysiologyState& state, std::span<const double> occupied_m,
                                      double breath) {
  const double phase = state.heart.phase;
  scene_.moving.resize(own_);
  scene_.shafts.clear();
  for (std::size_t b = 0; b < thorax_->size(); ++b)
    scene_.moving[b].p_P = points_of(vascular::at((*thorax_)[b], vascular::contraction(phase), breath).vertices);
  fluoro::Body& lumen = scene_.moving[thorax_->size()];
  shape_.at(state.radius_m, phase, breath, vertices_);
  lumen.p_P = points_of(vertices_);
  const vascular::FlowInputs in{{}, state.radius_m, occupied_m, 0};
  opacify(map_, {physiology_.flow, physiology_.contrast, state.contrast, in, phase, breath},
          {{lumen.contrast.iodine_kg_m3.data(), static_cast<std::size_t>(lumen.contrast.iodine_kg_m3.size())},
           lumen.contrast.p_PC,
           lumen.contrast.along_kg_m2},
          scratch_);
  fill_twigs(phase, breath);
  return scene_;
}

/// As dense as the blood where each leaves its vessel.
void PatientScene::fill_twigs(double phase, double breath) {
  const fluoro::Contrast& from = lumen().contrast;
  fluoro::Body& body = scene_.moving[thorax_->size() + 1];
  fill(
      *twigs_, [&](int root) { return from.iodine_kg_m3[root]; }, body);
  if (!is_seen(body.contrast)) return;  // they have no tissue of their own
  vascular::at(*twigs_, patient_.lumen, phase, breath, vertices_);
  place(*twigs_, vertices_, body);
}

}  // namespace ostium::app
