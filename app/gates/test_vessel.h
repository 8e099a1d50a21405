#pragma once
/// A vessel to test contact in: a curved trunk with an arch, and two branches of 3 mm that beat. No anatomy.
#include "core/wall/surface.h"

namespace ostium::app::gates {

/// The introducer is at `entry`, the branches part some 0.3 m along the trunk; 24 frames.
struct TestVessel {
  core::SurfaceDescription wall;
  Eigen::Vector3d entry_W;  ///< m, within the lumen; into it along x
  /// A way from the entry to the far end of a branch, m, in frame 0.
  std::vector<Eigen::Vector3d> ways_W[2];
};

/// About 26,000 triangles. `beat_m`: how far the far ends of the branches go.
TestVessel test_vessel(double beat_m = 12e-3);

}  // namespace ostium::app::gates
