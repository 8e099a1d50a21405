#include "app/session/live/live_picture.h"

#include <algorithm>

namespace ostium::app {

namespace {

constexpr std::size_t stored_runs = 4;
constexpr std::size_t stored_frames = 450;  ///< of a run: half a minute

bool shows_the_same(const PictureSettings& a, const PictureSettings& b) {
  return a.gamma == b.gamma && a.level == b.level && a.width == b.width && a.review == b.review &&
         a.review_frame == b.review_frame && a.references == b.references;
}

}  // namespace

LivePicture::LivePicture(const SessionModel& model, const LivePictureOptions& options)
    : model_(model), filmed_(options.filmed), has_pedals_(options.has_pedals) {
  const std::vector<std::string> names = signal_names(model);
  contrast_at_ = static_cast<std::size_t>(std::find(names.begin(), names.end(), "contrast_landmark") - names.begin());
  if (filmed_) return;
  FilmOptions look;
  look.always_on = !has_pedals_;
  look.pixels = options.pixels, look.renderer = options.renderer;
  own_.emplace(model, look);
}

/// Whether this snapshot is exposed: the first one of each frame, which falls on the nearest step.
bool LivePicture::is_due(const Snapshot& now) {
  const double frame = std::round(seconds(model_, now.state) * now.picture.frames_per_s);
  if (frame == due_) return false;
  due_ = frame;
  return true;
}

bool LivePicture::look(const Snapshot& now, bool fresh) {
  const double seen = contrast_at_ < now.signals.size() ? now.signals[contrast_at_] : NAN;
  const bool other = !shows_the_same(settings_, now.picture);
  // A run that goes back has not been exposed since: the image held, and its dose, are of a time that is given up.
  const bool gone_back = fresh && now.begun != begun_;
  second_ = seconds(model_, now.state);
  if (gone_back) begun_ = now.begun, forget_after(second_);
  bool is_new = false;
  if (own_) {
    if (!fresh) return false;
    is_new = !now.paused || gone_back;
    if (is_new && is_due(now)) {
      const CArmInputs& arm = now.inputs.c_arm;
      own_->set({now.picture.shutters, now.picture.frames_per_s, now.picture.roadmap});
      take(own_->frame(model_, now.state, now.inputs, now.xrays), own_->dose(), arm.beam(), arm.cine, seen);
    }
  } else if (filmed_->update()) {
    // Each frame is drawn once, with its picture; while the run is paused there are none.
    const Filmed& last = filmed_->front();
    take(last.picture, last.dose, last.xray_on, last.cine, seen);
    is_new = true;
  }
  if (!is_new && !other && !(fresh && now.paused)) return false;
  show(now.picture);
  return true;
}

void LivePicture::take(const fluoro::Picture& picture, const fluoro::DoseMeter& dose, bool xray_on, bool cine,
                       double seen) {
  // With the beam off it is the last image, held and marked so; before the first there is none.
  if (xray_on || !has_pedals_ || !picture_.grey.empty()) picture_ = picture;
  store(picture_, cine);
  xray_on_ = xray_on || !has_pedals_, dose_ = dose, cine_ = cine;
  reference_.take(picture_, cine, seen, second_);
}

void LivePicture::store(const fluoro::Picture& picture, bool cine) {
  if (!cine) return;
  if (!cine_) {
    runs_.emplace_front();
    if (runs_.size() > stored_runs) runs_.pop_back();
  }
  runs_.front().last_s = second_;
  if (runs_.front().frames.size() < stored_frames) runs_.front().frames.push_back(picture);
}

void LivePicture::forget_after(double second) {
  picture_ = {}, due_ = -1, cine_ = false;
  std::erase_if(runs_, [&](const StoredRun& run) { return run.last_s > second; });
  reference_.forget_after(second);
}

void LivePicture::show(const PictureSettings& settings) {
  settings_ = settings;
  shown_ = picture_, review_frame_ = review_frames_ = 0;
  if (const int run = settings.review; run > 0 && run <= static_cast<int>(runs_.size())) {
    const std::vector<fluoro::Picture>& frames = runs_[static_cast<std::size_t>(run - 1)].frames;
    const int count = static_cast<int>(frames.size());
    // From the run's middle on, round and round: there the arteries are full.
    const int at = count ? (((count / 2 + settings.review_frame) % count) + count) % count : 0;
    if (count) shown_ = frames[static_cast<std::size_t>(at)], review_frame_ = at + 1, review_frames_ = count;
  }
  if (settings.references != references_) {
    references_ = settings.references;
    if (!shown_.grey.empty()) reference_.freeze(shown_, second_);
  }
  window_greys(settings, shown_);
}

}  // namespace ostium::app
