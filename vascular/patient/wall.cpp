#include "vascular/patient/wall.h"

namespace ostium::vascular {

core::SurfaceDescription wall_of(const MovingLumen& lumen, double opened) {
  core::SurfaceDescription wall;
  for (int f = 0; f < beat_frames; ++f)
    wall.frames.push_back(lumen.at(static_cast<double>(f) / beat_frames, 0, opened).vertices);
  wall.triangles = lumen.triangles;
  wall.sway = lumen.breath;
  return wall;
}

double frame_at(double phase) { return beat_frames * phase; }

}  // namespace ostium::vascular
