#include "app/angiography/patient_scene.h"

#include "app/angiography/xray_body.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::app {

PatientScene::PatientScene(const vascular::Patient& patient, const vascular::PhysiologyModel& physiology, bool breathes)
    : patient_(patient),
      physiology_(physiology),
      map_(make_lumen_map(patient, physiology.flow)),
      shape_(patient, map_, physiology.flow.tree),
      breathes_(breathes),
      twigs_(std::make_shared<const vascular::Twigs>(grow_twigs(patient))) {
  std::vector<fluoro::Body> still;
  std::vector<vascular::XrayBody> moving;
  for (vascular::XrayBody& body : make_thorax(patient.anatomy)) {
    if (body.beat.empty() && !(breathes && !body.breath.empty())) {
      still.push_back(body_of(body));
    } else {
      scene_.moving.push_back(body_of(body));
      set_still(body, breathes, scene_.moving.back());
      moving.push_back(std::move(body));
    }
  }
  scene_.fixed = std::make_shared<const std::vector<fluoro::Body>>(std::move(still));
  thorax_ = std::make_shared<const std::vector<vascular::XrayBody>>(std::move(moving));
  const auto n = static_cast<Eigen::Index>(patient.lumen.vertices());
  fluoro::Body lumen{.name = "lumen",
                     .triangles = triangles_of(patient.lumen.triangles),
                     .p_P = Eigen::Matrix3Xf(3, n),
                     .tissue = {},  // a coronary artery of 3 mm differs from what is round it by half a percent
                     .within = {},
                     .contrast = {}};
  lumen.contrast.iodine_kg_m3 = Eigen::VectorXf::Zero(n);
  lumen.contrast.p_PC = lumen.contrast.along_kg_m2 = Eigen::Matrix3Xf::Zero(3, n);
  scene_.moving.push_back(std::move(lumen));
  own_ = scene_.moving.size();
  set_still_lumen();
}

PatientScene::PatientScene(const PatientScene& same, const vascular::PhysiologyModel& physiology)
    : patient_(same.patient_),
      physiology_(physiology),
      map_(same.map_),
      shape_(patient_, map_, physiology.flow.tree),
      thorax_(same.thorax_),
      breathes_(same.breathes_),
      twigs_(same.twigs_),
      scene_(same.scene_),
      own_(same.own_) {
  scene_.moving.resize(own_);
  scene_.shafts.clear();
}

/// Coronaries do not rest, even where nothing beats: treatment changes them.
void PatientScene::set_still_lumen() {
  const vascular::MovingLumen& from = patient_.lumen;
  fluoro::Body& body = lumen();
  for (std::size_t v = 0; v < from.vertices(); ++v)
    body.p_P.col(static_cast<Eigen::Index>(v)) = from.healthy(v, 0, 0).cast<float>();
  fluoro::set_still(
      [&](int vertex) {
        const auto v = static_cast<std::size_t>(vertex);
        return v >= from.moving && map_.sources[v].first.part != vascular::VertexSource::coronary &&
               (!breathes_ || from.breath[v].isZero(0));
      },
      body);
  body.still = 0;  // contrast fills what rests, too
}

const fluoro::Scene& PatientScene::at(const vascular::PhysiologyState& state, std::span<const double> occupied_m,
                                      double breath_depth, std::span<const Eigen::Vector3d> aside_P) {
  const double phase = state.heart.phase, breath = breathes_ ? breath_depth : 0;
  const vascular::LumenMoment moment{phase, breath, aside_P};
  scene_.moving.resize(own_);
  scene_.shafts.clear();
  for (std::size_t b = 0; b < thorax_->size(); ++b)
    move((*thorax_)[b], vascular::contraction(phase), breath, scene_.moving[b]);
  fluoro::Body& body = lumen();
  const vascular::FlowInputs in{{}, state.radius_m, occupied_m, 0};
  opacify(map_, {physiology_.flow, physiology_.contrast, state.contrast, in, moment, fluoro::faintest_iodine_kg_m3},
          {{body.contrast.iodine_kg_m3.data(), static_cast<std::size_t>(body.contrast.iodine_kg_m3.size())},
           body.contrast.p_PC,
           body.contrast.along_kg_m2},
          scratch_);
  if (fluoro::is_seen(body.contrast)) shape_.at(*body.corners, state.radius_m, moment, body.p_P);
  add_twigs(moment);
  return scene_;
}

/// As dense as the blood where each leaves its vessel.
void PatientScene::add_twigs(const vascular::LumenMoment& moment) {
  const fluoro::Contrast& from = lumen().contrast;
  twigs_.fill([&](int root) { return from.iodine_kg_m3[root]; });
  if (!twigs_.empty())
    scene_.moving.push_back(twigs_.at(patient_.lumen, moment.phase, moment.breath,
                                      [&](int root) { return shape_.aside(static_cast<std::size_t>(root), moment); }));
}

}  // namespace ostium::app
