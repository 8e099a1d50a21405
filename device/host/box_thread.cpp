#include "device/host/box_thread.h"

#include <utility>

namespace ostium::device {

BoxThread::BoxThread(std::unique_ptr<Port> port, const TrackingBoxSettings& settings)
    : port_(std::move(port)), box_(*port_, settings), thread_([this] {
        while (!over_.load(std::memory_order_relaxed)) {
          box_.poll(0.02, requests_.take());
          snapshots_.put(box_.now());
        }
      }) {}

BoxThread::~BoxThread() {
  over_.store(true, std::memory_order_relaxed);
  thread_.join();
}

}  // namespace ostium::device
