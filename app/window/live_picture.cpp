#include "app/window/live_picture.h"

namespace ostium::app {

LivePicture::LivePicture(const SessionModel& model, const LivePictureOptions& options)
    : model_(model), filmed_(options.filmed), has_pedals_(options.has_pedals) {
  if (filmed_) return;
  FilmOptions look;
  look.always_on = !has_pedals_;
  look.frames_per_s = options.frames_per_s;
  look.pixels = options.pixels;
  own_.emplace(model, look);
}

bool LivePicture::look(const Snapshot& now, bool fresh) {
  if (own_) {
    if (!fresh) return false;
    const CArmInputs& arm = now.inputs.c_arm;
    take(own_->frame(model_, now.state, now.inputs, now.xrays), own_->dose(), arm.beam(), arm.cine);
    return true;
  }
  // Each frame is drawn once, with its picture; while the run is paused there are none.
  if (!filmed_->update()) return fresh && now.paused;
  const Filmed& last = filmed_->front();
  take(last.picture, last.dose, last.xray_on, last.cine);
  return true;
}

void LivePicture::take(const fluoro::Picture& picture, const fluoro::DoseMeter& dose, bool xray_on, bool cine) {
  if (xray_on || !has_pedals_) picture_ = picture;
  dose_ = dose, cine_ = cine;
}

}  // namespace ostium::app
