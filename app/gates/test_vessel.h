#pragma once
/// A vessel for contact tests: a curved trunk with an arch, and two moving branches of 3 mm. Not anatomical.
#include "core/wall/surface.h"

namespace ostium::app::gates {

/// The introducer is at `entry`; the branches divide about 0.3 m along the trunk; 24 frames.
struct TestVessel {
  core::SurfaceDescription wall;
  Eigen::Vector3d entry_W;  ///< m, within the lumen; the direction in is x
  /// Paths from the entry to the far end of each branch, m, in frame 0.
  std::vector<Eigen::Vector3d> ways_W[2];
};

/// About 26,000 triangles. `beat_m`: amplitude of the branches' far ends.
TestVessel test_vessel(double beat_m = 12e-3);

}  // namespace ostium::app::gates
