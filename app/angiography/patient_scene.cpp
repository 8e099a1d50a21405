#include "app/angiography/patient_scene.h"

#include "app/angiography/xray_body.h"
#include "data/formats/load_error.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::app {

vascular::PhysiologyModel circulation_of(const vascular::Patient& patient, const std::string& name,
                                         std::uint64_t seed) {
  vascular::PhysiologyModel model = make_physiology(patient, seed);
  if (model.flow.tree.cells.empty())
    throw data::LoadError(name +
                          ": no coronary artery leaves an aorta in it, so no blood flows; expected a case that has "
                          "both. `ostium run` and `frame` take it as it is");
  return model;
}

PatientScene::PatientScene(const vascular::Patient& patient, const vascular::PhysiologyModel& physiology, bool breathes)
    : patient_(patient),
      physiology_(physiology),
      map_(make_lumen_map(patient, physiology.flow)),
      shape_(patient, map_, physiology.flow.tree),
      breathes_(breathes),
      lumen_(patient, map_, physiology.flow),
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
  own_ = scene_.moving.size();
}

PatientScene::PatientScene(const PatientScene& same, const vascular::PhysiologyModel& physiology)
    : patient_(same.patient_),
      physiology_(physiology),
      map_(same.map_),
      shape_(patient_, map_, physiology.flow.tree),
      thorax_(same.thorax_),
      breathes_(same.breathes_),
      lumen_(same.lumen_),
      twigs_(same.twigs_),
      scene_(same.scene_),
      own_(same.own_) {
  scene_.moving.resize(own_);
  scene_.shafts.clear();
}

const fluoro::Scene& PatientScene::at(const vascular::PhysiologyState& state, std::span<const double> occupied_m,
                                      double breath_depth, std::span<const Eigen::Vector3d> aside_P) {
  const double phase = state.heart.phase, breath = breathes_ ? breath_depth : 0;
  const vascular::LumenMoment moment{phase, breath, aside_P};
  scene_.moving.resize(own_);
  scene_.shafts.clear();
  for (std::size_t b = 0; b < thorax_->size(); ++b)
    move((*thorax_)[b], vascular::contraction(phase), breath, scene_.moving[b]);
  const vascular::FlowInputs in{{}, state.radius_m, occupied_m, 0};
  opacify(map_, {physiology_.flow, physiology_.contrast, state.contrast, in, moment, fluoro::faintest_iodine_kg_m3},
          lumen_.opacity(), scratch_);
  lumen_.fill(patient_.lumen.triangles);
  if (!lumen_.empty()) {
    shape_.at(lumen_.vertices(), state.radius_m, moment, lumen_.p_P());
    scene_.moving.push_back(lumen_.body());
  }
  add_twigs(moment);
  return scene_;
}

/// As dense as the blood where each leaves its vessel.
void PatientScene::add_twigs(const vascular::LumenMoment& moment) {
  twigs_.fill([&](int root) { return lumen_.iodine_kg_m3()[root]; });
  if (!twigs_.empty())
    scene_.moving.push_back(twigs_.at(patient_.lumen, moment.phase, moment.breath,
                                      [&](int root) { return shape_.aside(static_cast<std::size_t>(root), moment); }));
}

}  // namespace ostium::app
