#pragma once
/// A tracking box on a thread of its own: it polls the port; another thread takes the newest snapshot and says what the
/// simulation asks. They meet in two latches, so neither waits for the other.
#include <atomic>
#include <memory>
#include <thread>

#include "core/base/triple_buffer.h"
#include "device/host/tracking_box.h"

namespace ostium::device {

class BoxThread {
 public:
  BoxThread(std::unique_ptr<Port> port, const TrackingBoxSettings& settings);
  ~BoxThread();  ///< ends the thread; the box's watchdog opens its clamps

  // All of one thread:
  const BoxSnapshot& newest() { return snapshots_.take(); }
  void ask(const BoxRequest& request) { requests_.put(request); }

 private:
  std::unique_ptr<Port> port_;
  TrackingBox box_;
  core::TripleBuffer<BoxSnapshot> snapshots_;
  core::TripleBuffer<BoxRequest> requests_;
  std::atomic<bool> over_{false};
  std::thread thread_;
};

}  // namespace ostium::device
