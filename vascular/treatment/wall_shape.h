#pragma once
/// The lumen's surface as balloons, stents, spasm and drugs have left it: every vertex follows the radius of its cell.
///
/// Between the diseased and the healthy size a vertex lies between the two walls; beyond, its distance from the
/// centreline is scaled.
#include "core/wall/surface.h"
#include "vascular/contrast/lumen_map.h"
#include "vascular/patient/patient.h"

namespace ostium::vascular {

class WallShape {
 public:
  /// Keeps references.
  WallShape(const Patient& patient, const LumenMap& map, const FlowTree& tree);

  /// Vertices at a phase and depth of breath, for a radius of each cell. `vertices`: (#vertices of MovingLumen).
  void at(std::span<const double> radius_m, double phase, double breath, std::vector<Eigen::Vector3d>& vertices) const;
  /// One vertex.
  Eigen::Vector3d vertex(std::size_t v, std::span<const double> radius_m, double phase, double breath) const;
  /// As the wall that contact knows, for a session to make its surface anew when something has been opened.
  core::SurfaceDescription wall(std::span<const double> radius_m) const;

 private:
  const Patient& patient_;
  const LumenMap& map_;
  const FlowTree& tree_;
  std::vector<int> narrowed_;  ///< (#vertices) its place in MovingLumen::narrowed, or -1
};

}  // namespace ostium::vascular
