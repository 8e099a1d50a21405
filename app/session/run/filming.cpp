#include "app/session/run/filming.h"

#include <array>
#include <atomic>
#include <semaphore>
#include <thread>

#include "core/base/thread_priority.h"
#include "data/formats/video.h"

namespace ostium::app {

namespace {

constexpr int queued_frames = 8;

}  // namespace

struct Filming::Parts {
  struct Exposed {
    SessionState state;
    SessionInputs inputs;
    Monitor monitor;
    XrayUse xrays;
  };

  Parts(const SessionModel& m, const std::string& mp4, const FilmOptions& o, Driver* i)
      : model(m), file(mp4), pixels(o.pixels), film(m, o), rate(o.frames_per_s), inner(i) {}

  const SessionModel& model;
  std::string file;
  int pixels;
  Film film;
  double rate;
  Driver* inner;
  Monitor monitor;  // of the thread that steps
  std::array<Exposed, queued_frames> queue;
  core::TripleBuffer<Filmed> pictures{{}};
  std::counting_semaphore<queued_frames> free{queued_frames}, taken{0};
  int next = 0;
  std::atomic<bool> over{false}, watched{false};
  std::string problem;
  std::thread thread;

  void show(const fluoro::Picture& picture, const CArmInputs& arm) {
    Filmed& filmed = pictures.back();
    filmed.picture = picture;
    filmed.picture.height = picture.width;
    filmed.picture.grey.resize(static_cast<std::size_t>(picture.width) * picture.width);
    filmed.dose = film.dose();
    filmed.cine = arm.cine, filmed.xray_on = arm.beam();
    pictures.publish();
  }

  void develop() {
    core::give_way_to_steps();
    data::VideoWriter video(file, pixels, film.height(), rate);  // here, so that the encoder gives way, too
    for (int at = 0;; at = (at + 1) % queued_frames) {
      taken.acquire();
      if (over.load(std::memory_order_acquire) && at == next) break;
      Exposed& e = queue[static_cast<std::size_t>(at)];
      try {
        film.monitor() = e.monitor;
        if (watched || problem.empty()) {
          const fluoro::Picture& picture = film.frame(model, e.state, e.inputs, e.xrays);
          if (watched) show(picture, e.inputs.c_arm);
          if (problem.empty()) video.add(picture);
        }
      } catch (const std::exception& error) {
        problem = error.what();
      }
      free.release();
    }
    if (!video.finish() && problem.empty()) problem = video.problem();
  }
};

Filming::Filming(const SessionModel& model, const std::string& mp4, const FilmOptions& options, Driver* inner)
    : parts_(std::make_unique<Parts>(model, mp4, options, inner)) {
  parts_->thread = std::thread([this] { parts_->develop(); });
}

Filming::~Filming() { finish(); }

bool Filming::marks() { return parts_->inner && parts_->inner->marks(); }

void Filming::remark(std::vector<OperatorEvent>& events) {
  if (parts_->inner) parts_->inner->remark(events);
}

bool Filming::holds_script() const { return parts_->inner && parts_->inner->holds_script(); }

Driven Filming::drive(const ScriptedRun& run, SessionInputs& inputs) {
  Parts& p = *parts_;
  const Driven driven = p.inner ? p.inner->drive(run, inputs) : Driven::on;
  if (driven == Driven::over) return driven;
  p.monitor.listen(run.model, run.state, inputs);
  if (is_frame(run.state.rods.step, p.rate, run.model.step_s())) {
    p.free.acquire();
    Parts::Exposed& e = p.queue[static_cast<std::size_t>(p.next)];
    e.state = run.state, e.inputs = inputs, e.monitor = p.monitor, e.xrays = run.xrays;
    p.next = (p.next + 1) % queued_frames;
    p.taken.release();
  }
  return driven;
}

core::TripleBuffer<Filmed>& Filming::pictures() {
  parts_->watched = true;
  return parts_->pictures;
}

std::string Filming::finish() {
  Parts& p = *parts_;
  if (p.thread.joinable()) {
    // All places in the queue are free again once the last picture is taken.
    for (int i = 0; i < queued_frames; ++i) p.free.acquire();
    p.over.store(true, std::memory_order_release);
    p.taken.release();
    p.thread.join();
  }
  return p.problem;
}

}  // namespace ostium::app
