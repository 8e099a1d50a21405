#pragma once
/// Tells inside from outside by the triangles alone, and shares nothing with contact but the triangles.
#include "core/wall/surface.h"

namespace ostium::core {

/// Of a point to a triangle, m: by projection into its plane, else the nearest side; not how contact does it.
double triangle_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                         const Eigen::Vector3d& c);

class PenetrationOracle {
 public:
  explicit PenetrationOracle(const SurfaceDescription& wall);  ///< keeps a reference

  /// Takes the wall as it is at this moment of its cycle.
  void set_frame(double frame);

  /// Distance to the nearest triangle, m; those farther than `far_m` need not be told apart.
  double distance_m(const Eigen::Vector3d& p, double far_m) const;

  /// Generalised winding number: 1 inside a closed surface, 0 outside (van Oosterom, Strackee 1983; Jacobson et al.
  /// 2013).
  double winding(const Eigen::Vector3d& p) const;

 private:
  const SurfaceDescription& wall_;
  std::vector<Eigen::Vector3d> vertices_;
  Eigen::ArrayXd x_, y_, z_, radius_;  ///< of spheres round the triangles
};

}  // namespace ostium::core
