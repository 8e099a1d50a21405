#pragma once
/// A vessel as a row of spheres along a curve, and the smooth union of several.
#include <Eigen/Core>
#include <string>
#include <vector>

namespace ostium::vascular {

struct TubeNode {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< patient frame, metres
  double radius_m = 0;                          ///< > 0
  double s_m = 0;                               ///< arc length from the first node
};

struct Tube {
  std::string name;
  int parent = -1;              ///< tube it leaves, less than its own index; -1: a root
  double blend = 1;             ///< width of the rounding at its origin, in its own radii
  std::vector<TubeNode> nodes;  ///< at least two; neighbours overlap
  bool leaves_parent = true;    ///< false: not a branch of the tree (a sinus, a chamber)

  double length_m() const { return nodes.back().s_m; }
  TubeNode at(double s_m) const;              ///< interpolated; s is clamped to the tube
  Eigen::Vector3d tangent(double s_m) const;  ///< unit
};

/// A point on a tube's course.
struct CoursePoint {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  double radius_m = 0;  ///< 0: interpolated between points that have one
};

/// A tube through `course` (first and last points must have a radius), with a node about every quarter radius; the
/// curve is a cubic spline, the radius a monotone cubic of arc length.
Tube make_tube(const std::string& name, int parent, const std::vector<CoursePoint>& course);

/// Arc length at which `tube` comes nearest to `p`.
double nearest_s(const Tube& tube, const Eigen::Vector3d& p);

/// A tube's share in a point's position; the weights of all shares add up to one.
struct TubeShare {
  int tube = 0;
  double s_m = 0;
  double weight = 0;
};

/// Function similar to a signed distance, zero on the union's surface, negative inside. Where a tube leaves its parent
/// the surface is rounded (cubic smooth minimum), so no inner walls remain. Lipschitz constant near 1.
class TubeUnion {
 public:
  explicit TubeUnion(const std::vector<Tube>& tubes);  ///< keeps a reference

  struct Segment {
    int tube, node;            ///< between nodes[node] and nodes[node + 1]
    Eigen::Vector3d p, along;  ///< first node, and vector to the second, m
    double length2, radius_m, widening_m;
  };
  const std::vector<Segment>& segments() const { return segments_; }
  const std::vector<Tube>& tubes() const { return tubes_; }

  /// Distance of `p` to a segment's cone of spheres.
  double distance(int segment, const Eigen::Vector3d& p, double* s_m = nullptr, double* radius_m = nullptr) const;
  double largest_blend_m() const { return largest_blend_m_; }

  /// The function for some segments only (indices, ascending). `gradient` and `shares` may be null.
  double value(const Eigen::Vector3d& p, const std::vector<int>& segments, Eigen::Vector3d* gradient = nullptr,
               std::vector<TubeShare>* shares = nullptr) const;

 private:
  const std::vector<Tube>& tubes_;
  std::vector<Segment> segments_;
  double largest_blend_m_ = 0;
};

}  // namespace ostium::vascular
