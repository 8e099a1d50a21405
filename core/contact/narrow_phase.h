#pragma once
/// Turns each triangle near a node into a plane.
#include <cmath>

#include "core/model/model.h"
#include "core/model/scratch.h"
#include "core/model/state.h"
#include "core/wall/triangle.h"

namespace ostium::core {

inline double norm(const V3<double>& v) { return std::sqrt(dot(v, v)); }

enum class StepEnd { before, after };

/// A node as a ball, at the beginning or the end of the step.
struct NodeView {
  V3<double> centre;
  double radius, reach;
  V3<double> tangent;  ///< of the rod
  double cell;         ///< m, length of rod that the node stands for
};

/// Of node i of a rod with its centre at `centre`; it sees `travel` beyond its surface, m.
NodeView view_of(const Rod& rod, const RodState& state, int i, const V3<double>& centre, double travel);

/// A point of a triangle, at both ends of the step.
struct Foot {
  V3<double> now, before, after;
};

WallPlane plane_of(const Surface& surface, const NodeView& view, const V3<double>& normal, double gap,
                   const Foot& foot);

/// The point of a triangle that is nearest to a ball.
struct SeenTriangle {
  TrianglePoint point;
  V3<double> foot, normal;  ///< m; normal into the lumen
  double gap = 0;           ///< m, negative behind the wall
  double facing = 1;        ///< as of WallPlane
  bool at_rim = false;      ///< the nearest point is on the triangle's rim
};

/// False if the triangle is out of reach. Its own face says on which side the ball is; of a soft wall, at its rim, all
/// faces round it do.
bool see(const Surface& surface, const Surface::Cluster& c, const Surface::Triangle& t, const Field<3>& now,
         const NodeView& view, SeenTriangle& sight);

/// The triangle of a plane again, by a ball that has gone on in sight of it: round its rim it stays on its side.
bool see_again(const Surface& surface, const WallPlane& was, const Field<3>& now, const NodeView& view,
               SeenTriangle& sight);

/// The plane of that triangle.
WallPlane plane_of(const Surface& surface, const NodeView& view, const Surface::Triangle& t, const ClusterPose& pose,
                   const Field<3>& now, const SeenTriangle& sight);

/// Adds the planes of a cluster's triangles within reach at one end of the step; `passes`: ignores its door.
void look(const Model& model, int at_surface, int cluster, const ClusterPose& pose, StepEnd end, const NodeView& view,
          bool passes, NodeWalls& walls);

/// No triangle of the cluster is nearer to a point at the beginning of the step, m.
double least_distance(const ClusterPose& pose, int triangles, const V3<double>& p);

/// After the last look: joins soft walls and removes walls seen from behind.
void sum_up(const NodeView& view, NodeWalls& walls);

/// Whether two planes belong to the same soft wall.
bool one_soft_wall(const WallPlane& a, const WallPlane& b);

/// Whether an open door lets a node of that radius through.
bool lets_through(const Surface& surface, const SurfacePose& whole, double radius);

/// A growing bounding box.
struct Bounds {
  V3<double> low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  void take(const V3<double>& p, double reach) {
    low = {least(low.x, p.x - reach), least(low.y, p.y - reach), least(low.z, p.z - reach)};
    high = {largest(high.x, p.x + reach), largest(high.y, p.y + reach), largest(high.z, p.z + reach)};
  }
};

}  // namespace ostium::core
