#pragma once
/// What a case that is being edited looks like: its diseased wall, and X-ray pictures of it. Building takes seconds, so
/// each is built once for a revision.
#include <memory>

#include "app/session/scene/xray_scene.h"
#include "data/catalogue/case/case_draft.h"
#include "fluoro/console/fluoroscope.h"

namespace ostium::app {

class DraftPicture {
 public:
  /// At end-diastole. Throws std::invalid_argument where no patient can be made of the case.
  vascular::Mesh wall(const data::CaseDraft& draft);
  /// A cine frame in mid-diastole, coronary arteries filled. Throws LoadError, std::invalid_argument.
  fluoro::Picture frame(const data::CaseDraft& draft, Fill fill, double lao_rad, double cran_rad);

 private:
  int wall_of_ = -1, scene_of_ = -1;  ///< revisions
  vascular::Mesh wall_;
  Fill fill_ = Fill::none;
  CaseScene scene_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
};

}  // namespace ostium::app
