#pragma once
/// Reference implementation for frame times: the picture of P. Korzeniowski's thesis (2015), whose opacity grows with
/// the angle between surface and line of sight. Every triangle is drawn every frame, blended into 8 bits, by OSMesa in
/// the calling thread.
#include <memory>
#include <span>

#include "fluoro/projection/path_lengths.h"

namespace ostium::bench {

class AngleOpacity {
 public:
  explicit AngleOpacity(std::vector<fluoro::Body> bodies);
  ~AngleOpacity();
  /// Draws and reads back; returns the mean grey level, so that no work can be skipped.
  double draw(const fluoro::View& view);

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

}  // namespace ostium::bench
