#pragma once
#include <cstdint>
#include <vector>

#include "data/assessment/events.h"

namespace ostium::app {

/// An event of one step of the loop, for the recording.
struct SessionEvent {
  std::uint64_t step = 0;
  int code = 0;   ///< EventCode of data/assessment/events.h
  int tool = -1;  ///< -1: none
  double value = 0;
};

/// Collects the events of one step.
struct EventSink {
  std::uint64_t step;
  std::vector<SessionEvent>& events;
  void operator()(data::EventCode code, int tool = -1, double value = 0) const {
    events.push_back({step, static_cast<int>(code), tool, value});
  }
};

}  // namespace ostium::app
