#include "app/session/scene/dose.h"

#include <cmath>
#include <stdexcept>

#include "app/session/scene/frames.h"
#include "app/session/scene/xray_scene.h"

namespace ostium::app {

void XrayUse::add(const CArmInputs& arm, std::uint64_t step, double step_s) {
  if (!arm.beam() || !is_frame(step, dose_frames_per_s, step_s)) return;
  for (Pose& pose : poses_) {
    const CArmInputs& other = pose.arm;
    if (other.lao_rad != arm.lao_rad || other.cran_rad != arm.cran_rad || other.field_m != arm.field_m ||
        other.p_PI != arm.p_PI || other.cine != arm.cine)
      continue;
    pose.frames += 1;
    return;
  }
  poses_.push_back({arm, 1});
}

Dosimeter::Dosimeter(const Vessel& vessel)
    : scene_(vessel.patient ? XrayPatient(vessel.patient, Fill::none).at(0) : scene_of_mesh(vessel)) {}

std::optional<fluoro::Exposure> Dosimeter::exposure(fluoro::Imager& imager, const CArmInputs& arm) const {
  fluoro::View view;
  view.arm.lao_rad = arm.lao_rad, view.arm.cran_rad = arm.cran_rad, view.arm.p_PI = arm.p_PI;
  view.field_m = arm.field_m;
  try {
    require_reachable(view.arm);
  } catch (const std::invalid_argument&) {
    return {};
  }
  return imager.exposure(
      {.scene = scene_,
       .view = view,
       .collimator = fluoro::to_field,
       .programme = arm.cine ? fluoro::cine(dose_frames_per_s) : fluoro::fluoroscopy(dose_frames_per_s),
       .seed = 1});
}

void Dosimeter::measure(const XrayUse& use, data::RunRecord& record) const {
  record.kerma_Gy = record.dose_area_Gy_m2 = 0;
  fluoro::Imager imager({}, fluoro::make_scanline_renderer());
  for (const XrayUse::Pose& pose : use.poses())
    if (const auto e = exposure(imager, pose.arm))
      record.kerma_Gy += pose.frames * e->kerma_Gy, record.dose_area_Gy_m2 += pose.frames * e->dose_area_Gy_m2;
}

RunningDose::RunningDose(fluoro::Scene patient)
    : dosimeter_(std::move(patient)), imager_({}, fluoro::make_scanline_renderer()) {}

fluoro::DoseMeter RunningDose::of(const XrayUse& use, const CArmState& arm) {
  fluoro::DoseMeter dose;
  dose.fluoroscopy_s = arm.fluoroscopy_s;
  dose.cine_runs = std::lround(arm.cine_runs);
  for (std::size_t i = 0; i < use.poses().size(); ++i) {
    const XrayUse::Pose& pose = use.poses()[i];
    if (i == of_pose_.size()) of_pose_.push_back(dosimeter_.exposure(imager_, pose.arm));
    if (pose.arm.cine) dose.cine_frames += std::lround(pose.frames);
    if (!of_pose_[i]) continue;
    dose.kerma_Gy += pose.frames * of_pose_[i]->kerma_Gy;
    dose.dose_area_Gy_m2 += pose.frames * of_pose_[i]->dose_area_Gy_m2;
  }
  return dose;
}

}  // namespace ostium::app
