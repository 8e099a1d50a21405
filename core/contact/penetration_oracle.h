#pragma once
/// Tells inside from outside by the triangles alone; shares no code with contact.
#include "core/wall/surface.h"

namespace ostium::core {

/// Distance from a point to a triangle, m: projection into its plane, else the nearest side. Deliberately not contact's
/// method.
double triangle_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                         const Eigen::Vector3d& c);

class PenetrationOracle {
 public:
  explicit PenetrationOracle(const SurfaceDescription& wall);  ///< keeps a reference

  /// Takes the wall at this frame of its cycle.
  void set_frame(double frame);

  /// Distance to the nearest triangle, m, at most `far_m`.
  double distance_m(const Eigen::Vector3d& p, double far_m) const;

  /// Generalised winding number: 1 inside a closed surface, 0 outside (van Oosterom, Strackee 1983; Jacobson et al.
  /// 2013).
  double winding(const Eigen::Vector3d& p) const;

 private:
  const SurfaceDescription& wall_;
  std::vector<Eigen::Vector3d> vertices_;
  Eigen::ArrayXd x_, y_, z_, radius_;  ///< of bounding spheres of the triangles
};

}  // namespace ostium::core
