#pragma once
/// The lumen's surface as changed by balloons, stents, spasm and drugs: every vertex follows the radius of its cell.
///
/// From diseased to healthy size a vertex is interpolated between the two walls; beyond, its distance from the
/// centreline is scaled.
#include "core/wall/surface.h"
#include "vascular/contrast/lumen_map.h"
#include "vascular/patient/patient.h"

namespace ostium::vascular {

class WallShape {
 public:
  /// Keeps references.
  WallShape(const Patient& patient, const LumenMap& map, const FlowTree& tree);

  /// Vertices at a moment, for given cell radii. `vertices`: (#vertices of MovingLumen).
  void at(std::span<const double> radius_m, const LumenMoment& moment, std::vector<Eigen::Vector3d>& vertices) const;
  /// Those vertices alone, into their columns of `out`.
  void at(std::span<const int> which, std::span<const double> radius_m, const LumenMoment& moment,
          Eigen::Matrix3Xf& out) const;
  /// A single vertex.
  Eigen::Vector3d vertex(std::size_t v, std::span<const double> radius_m, const LumenMoment& moment) const;
  /// How far a vertex is pushed aside with the arteries that it belongs to.
  Eigen::Vector3d aside(std::size_t v, const LumenMoment& moment) const;
  /// The surface as a contact wall, from which a session rebuilds it after a vessel was opened.
  core::SurfaceDescription wall(std::span<const double> radius_m) const;

 private:
  Eigen::Vector3d vertex(std::size_t v, std::span<const double> radius_m, const LumenMoment& moment,
                         const PeriodicPoints::Moment& beat) const;

  const Patient& patient_;
  const LumenMap& map_;
  const FlowTree& tree_;
  std::vector<int> narrowed_;  ///< (#vertices) index in MovingLumen::narrowed, or -1
};

}  // namespace ostium::vascular
