#pragma once
/// A hand for an emulated box that nobody else moves: a guide that rests, and a wire that is pushed in and turned, in
/// strokes, each to the end of the travel, drawn back and held still; then taken out in as many. It sees nothing.
#include "device/emulator/emulated_box.h"

namespace ostium::device {

class StrokingHand {
 public:
  double mm_s = 120, deg_s = 90;
  int strokes = 4;

  /// Moves the tools by the box's time since the last call.
  void move(EmulatedBox& box);

 private:
  /// Towards a depth of the wire's tip beyond the introducer, and then still for a while.
  struct Move {
    double to_mm = 0, still_s = 0;
    bool outside = false;  ///< nothing is in the box then
  };
  Move move_of(int n, double station_mm) const;

  int next_ = 0;  ///< of the moves
  double last_s_ = 0, arrived_s_ = -1, tip_mm_ = 0;
  bool begun_ = false;
};

}  // namespace ostium::device
