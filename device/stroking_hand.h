#pragma once
/// A hand for an emulated box that nobody else moves: a guide that rests, and a wire pushed to the end of the travel,
/// turned, drawn back, held still, again and again; then out. It sees nothing of the simulation.
#include "device/emulated_box.h"

namespace ostium {

class StrokingHand {
 public:
  double mm_s = 120, deg_s = 90;
  int strokes = 4;

  /// Moves the tools by the box's time since the last call.
  void move(EmulatedBox& box);

 private:
  enum class Does { pushes, draws_back, holds, goes_out, rests };
  void next(Does does, double time_s) { does_ = does, since_s_ = time_s; }

  Does does_ = Does::rests;
  double last_s_ = 0, since_s_ = 0, depth_mm_ = 0;  ///< of the wire's tip beyond its station
  int done_ = 0;
};

}  // namespace ostium
