#pragma once
/// A scripted hand for an emulated box: the guide rests, and the wire is pushed in and turned in strokes, each to the
/// end of the travel, drawn back and held still; then it is taken out in as many strokes. It has no feedback.
#include "device/emulator/emulated_box.h"

namespace ostium::device {

class StrokingHand {
 public:
  double mm_s = 120, deg_s = 90;
  int strokes = 4;

  /// Moves the tools for the box time since the last call.
  void move(EmulatedBox& box);

 private:
  /// Moves the wire's tip to a depth beyond the introducer, then holds still for a while.
  struct Move {
    double to_mm = 0, still_s = 0;
    bool outside = false;  ///< the box is then empty
  };
  Move move_of(int n, double station_mm) const;

  int next_ = 0;  ///< index of the next move
  double last_s_ = 0, arrived_s_ = -1, tip_mm_ = 0;
  bool begun_ = false;
};

}  // namespace ostium::device
