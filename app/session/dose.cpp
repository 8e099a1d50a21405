#include "app/session/dose.h"

#include <stdexcept>

#include "app/session/film.h"

namespace ostium {

void XrayUse::add(const CArmInputs& arm, std::uint64_t step, double step_s) {
  if (!(arm.fluoroscopy > 0 || arm.cine > 0) || !is_frame(step, frames_per_s, step_s)) return;
  for (Pose& pose : poses_) {
    const CArmInputs& other = pose.arm;
    if (other.lao_rad != arm.lao_rad || other.cran_rad != arm.cran_rad || other.field_m != arm.field_m ||
        other.p_PI != arm.p_PI || (other.cine > 0) != (arm.cine > 0))
      continue;
    pose.frames += 1;
    return;
  }
  poses_.push_back({arm, 1});
}

Dosimeter::Dosimeter(std::shared_ptr<const Vessel> vessel) : vessel_(std::move(vessel)) {
  if (vessel_->patient) patient_ = std::make_unique<const XrayPatient>(vessel_->patient, Fill::none);
}

Dosimeter::~Dosimeter() = default;

void Dosimeter::measure(const XrayUse& use, RunRecord& record) const {
  record.kerma_Gy = record.dose_area_Gy_m2 = 0;
  if (use.poses().empty()) return;
  const Scene scene = patient_ ? patient_->at(0) : scene_of_mesh(*vessel_);
  Imager imager({}, make_scanline_renderer());
  for (const XrayUse::Pose& pose : use.poses()) {
    View view;
    view.arm.lao_rad = pose.arm.lao_rad, view.arm.cran_rad = pose.arm.cran_rad, view.arm.p_PI = pose.arm.p_PI;
    view.field_m = pose.arm.field_m;
    try {
      require_reachable(view.arm);
    } catch (const std::invalid_argument&) {
      continue;
    }
    const Exposure e = imager.exposure({.scene = scene,
                                        .view = view,
                                        .collimator = {},
                                        .programme = pose.arm.cine > 0 ? cine(frames_per_s) : fluoroscopy(frames_per_s),
                                        .seed = 1});
    record.kerma_Gy += pose.frames * e.kerma_Gy, record.dose_area_Gy_m2 += pose.frames * e.dose_area_Gy_m2;
  }
}

}  // namespace ostium
