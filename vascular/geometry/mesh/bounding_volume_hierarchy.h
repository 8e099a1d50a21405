#pragma once
/// A tree of axis-aligned boxes over the triangles of a mesh: which triangles come near a box, and how far a point is
/// from the surface. For checks and for preparing anatomy; the step has its own (core).
#include <Eigen/Geometry>
#include <functional>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

class BoundingVolumeHierarchy {
 public:
  /// Keeps a reference to `mesh`, whose triangles must not be degenerate beyond zero area.
  explicit BoundingVolumeHierarchy(const Mesh& mesh);

  /// Calls `visit(i, j)` once for each two triangles, i < j, whose boxes touch.
  void for_each_pair(const std::function<void(int, int)>& visit) const;

  struct Nearest {
    double distance_m = 0;
    int triangle = -1;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
  };
  /// The nearest point of the surface that is nearer than `limit_m`; triangle -1 if there is none.
  Nearest nearest(const Eigen::Vector3d& p, double limit_m) const;

  struct Hit {
    double distance_m = 0;
    int triangle = -1;
  };
  /// Triangles that the ray from `p` along the unit vector `along` goes through within `limit_m`, the nearest first.
  std::vector<Hit> hits(const Eigen::Vector3d& p, const Eigen::Vector3d& along, double limit_m) const;

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int first = 0, last = 0;  ///< triangles order_[first..last)
    int right = -1;           ///< the second child; the first is the next node; -1: a leaf
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
