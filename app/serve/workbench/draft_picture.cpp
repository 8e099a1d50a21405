#include "app/serve/workbench/draft_picture.h"

namespace ostium::app {

namespace {

constexpr double mid_diastole = 0.75;
constexpr int pixels = 512, frames = 4;  // the display's filter needs some

}  // namespace

vascular::Mesh DraftPicture::wall(const data::CaseDraft& draft) {
  if (wall_of_ != draft.revision()) {
    wall_ = patient_of(draft.now()).lumen.at(0, 0);
    wall_of_ = draft.revision();
  }
  return wall_;
}

fluoro::Picture DraftPicture::frame(const data::CaseDraft& draft, Fill fill, double lao_rad, double cran_rad) {
  if (scene_of_ != draft.revision() || fill_ != fill) {
    scene_ = scene_of_case(draft.now(), fill, middle_);
    scene_of_ = draft.revision(), fill_ = fill;
  }
  fluoro::View view;
  view.arm.lao_rad = lao_rad, view.arm.cran_rad = cran_rad, view.arm.p_PI = middle_;
  view.pixels = pixels;
  require_reachable(view.arm);
  fluoro::Scene scene = scene_.at(mid_diastole);
  const fluoro::FluoroscopeInput in{.scene = scene,
                                    .view = view,
                                    .collimator = fluoro::to_field,
                                    .pedals = {.fluoroscopy = false, .cine = true},
                                    .fluoroscopy_per_s = 15,
                                    .cine_per_s = 15,
                                    .seed = 1};
  fluoro::Imager imager({}, fluoro::make_renderer(fluoro::Renderer::scanline));
  fluoro::FluoroscopeState state;
  fluoro::DisplayScratch scratch;
  for (int i = 0; i < frames; ++i) tick(imager, in, state, scratch);
  return state.live;
}

}  // namespace ostium::app
