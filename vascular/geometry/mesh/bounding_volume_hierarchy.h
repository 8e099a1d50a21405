#pragma once
/// Axis-aligned bounding boxes over a mesh's triangles: which triangles are near a box, and the distance of a point
/// from the surface. For checks and preparing anatomy; the step has its own (core/wall).
#include <Eigen/Geometry>
#include <functional>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

class BoundingVolumeHierarchy {
 public:
  /// Keeps a reference to `mesh`, whose triangles must not be degenerate beyond zero area.
  explicit BoundingVolumeHierarchy(const Mesh& mesh);

  /// Calls `visit(i, j)` once for each pair of triangles, i < j, whose boxes touch.
  void for_each_pair(const std::function<void(int, int)>& visit) const;

  struct Nearest {
    double distance_m = 0;
    int triangle = -1;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
  };
  /// The nearest point of the surface within `limit_m`; triangle -1 if none.
  Nearest nearest(const Eigen::Vector3d& p, double limit_m) const;

  struct Hit {
    double distance_m = 0;
    int triangle = -1;
  };
  /// Triangles hit by the ray from `p` along the unit vector `along` within `limit_m`, nearest first.
  std::vector<Hit> hits(const Eigen::Vector3d& p, const Eigen::Vector3d& along, double limit_m) const;

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int first = 0, last = 0;  ///< triangles order_[first..last)
    int right = -1;           ///< second child (the first is the next node); -1: a leaf
  };
  void build(int first, int last, const std::vector<Eigen::Vector3d>& middles);
  void pairs(int a, int b, const std::function<void(int, int)>& visit) const;
  Eigen::AlignedBox3d box_of(int triangle) const;

  const Mesh& mesh_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

/// The point of triangle (a, b, c) nearest to `p` (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
Eigen::Vector3d nearest_on_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c);

}  // namespace ostium::vascular
