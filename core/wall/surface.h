#pragma once
/// A wall: triangles that move through the frames of a cycle. Constant once made; the reference that contact is tested
/// against.
///
/// Between frames a vertex moves on a periodic Catmull-Rom spline, so its velocity is continuous. Triangles are grouped
/// in clusters of up to 16, the leaves of a bounding volume hierarchy. A box encloses its contents over the whole
/// interval between two frames (it encloses the spline's Bezier points), so boxes are made once and never refitted;
/// positions are computed only for clusters near an instrument. A slow motion with its own rhythm, besides the cycle,
/// is a second set of displacements (`sway`), scaled by one number; each box has a second one for these displacements.
/// Walls that give way lie aside by a third set, which its owner changes between steps by a little at a time.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/math/huge_pages.h"
#include "core/math/lanes.h"

namespace ostium::core {

struct SurfaceDescription {
  /// Vertices, m: one frame if the wall stands still; else those of one cycle, evenly spaced in time.
  std::vector<std::vector<Eigen::Vector3d>> frames;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise as seen from outside of the lumen
  /// (#vertices), m: displacement of each at a sway of 1, the same in all frames. Empty: it does not sway.
  std::vector<Eigen::Vector3d> sway;
  /// Force per length of instrument and depth with which the wall resists being pushed outwards, N/m2; 0: rigid.
  double stiffness_N_m2 = 0;
  double friction = 0;  ///< against instruments, static and kinetic
  /// A door: triangles that instruments up to this radius pass while it is open (SurfaceMotion), and that are an
  /// ordinary wall otherwise. It hangs within the lumen: the surface is closed without it.
  std::vector<int> door;
  double door_passes_m = 0;  ///< radius
};

inline constexpr int cluster_size = 16;  ///< triangles

struct Box {
  std::array<float, 3> low, high;
};

/// Bounds of a cluster's corners in one frame of the cycle.
struct FrameBounds {
  Box box;
  float spread_m = 0;  ///< farthest that a corner moves to the next frame beside what the box's middle moves
  float unused = 0;    ///< one register's size
};

struct Surface {
  struct Cluster {
    int first_triangle = 0, triangles = 0;
    int first_corner = 0, corners = 0;  ///< its own copies of the vertices, in `corner_frames`
    bool stands_still = false;          ///< its corners are at the same position in all frames
    int version = 0;                    ///< changes with each edit of it
  };
  struct Node {    ///< of the tree, depth first: the first child follows its parent
    int skip = 0;  ///< next node if the box is missed
    int cluster = -1;
  };
  struct Triangle {
    std::array<unsigned char, 3> corner;  ///< of its cluster
    std::array<float, 3> curvature;       ///< 1/m: a, b, c of the shape operator, see curvature_towards
    int id = 0;                           ///< as described
    bool door = false;
  };

  std::vector<Cluster> clusters;
  std::vector<Triangle> triangles;
  int frames = 0;
  /// [cluster][frame][x, y, z][corner of it], m: in the order in which it is read.
  std::vector<float, OnHugePages<float>> corner_frames;
  std::vector<float> corner_sway;         ///< [cluster][x, y, z][corner of it], m; empty: it does not sway
  std::vector<int> corner_vertex;         ///< [corner], as described
  std::vector<V3<float>> corner_normals;  ///< [corner], outwards, of the first frame: of soft walls, to tell the side
  int corners = 0;
  std::vector<Node> nodes;
  std::vector<Box, OnHugePages<Box>> boxes;  ///< [interval][node]
  std::vector<Box> sway_boxes;               ///< [node], of displacements; empty: it does not sway
  /// [cluster][frame - 1 to frames + 1]: those of an interval are side by side. For clusters that move in the cycle.
  std::vector<FrameBounds, OnHugePages<FrameBounds>> frame_bounds;
  std::vector<float> corner_aside;  ///< as corner_sway, m; empty: it lies as described
  std::vector<Box> aside_boxes;     ///< [node], of these; empty as they are
  double moved_m = 0;               ///< how far edits have moved any corner so far, all summed up, at most
  double stiffness_N_m2 = 0, friction = 0, door_passes_m = 0;
  int largest_cluster = 0;  ///< in corners
  long edits = 0;           ///< number of changes of frames by a SurfaceEditor

  /// Start of an axis of a cluster's corners in `corner_frames`.
  std::size_t row(const Cluster& c, int frame, int axis) const {
    return std::size_t{3} * frames * c.first_corner + std::size_t{1} * (3 * frame + axis) * c.corners;
  }
  /// The same in `corner_sway` and `corner_aside`.
  std::size_t sway_row(const Cluster& c, int axis) const {
    return std::size_t{3} * c.first_corner + std::size_t{1} * axis * c.corners;
  }
  bool sways() const { return !corner_sway.empty(); }
  bool yields() const { return !corner_aside.empty(); }
  /// Bounds in the four frames from which positions of an interval are made.
  const FrameBounds* bounds_of(int cluster, int interval) const {
    return &frame_bounds[std::size_t{1} * cluster * (frames + 3) + interval];
  }
};

/// Throws std::invalid_argument if there is no triangle or frame, a triangle names a missing vertex, frames differ in
/// length (`sway` too), or a number is not finite or negative.
Surface make_surface(const SurfaceDescription& description);

/// Moves vertices of a surface for the whole cycle and refits the boxes, for walls that were opened or give way.
/// Triangles, clusters, normals, curvatures and sway stay. The result depends only on the positions, not on the order
/// of edits.
class SurfaceEditor {
 public:
  /// Keeps a reference. `description`: what the surface was made from.
  SurfaceEditor(const SurfaceDescription& description, Surface& surface);

  /// Sets one vertex in one frame; call `refit` after the last, and before the same one is set again.
  void place(int vertex, int frame, const Eigen::Vector3d& p_W);
  void refit();

  /// Makes room for a wall that gives way. Call once, before the first put_aside.
  void let_yield();
  /// How far one vertex lies aside in all frames; call `refit_aside` after the last, likewise.
  void put_aside(int vertex, const Eigen::Vector3d& by_W);
  void refit_aside();

 private:
  /// Marks the nodes around a corner, up to the root.
  void mark(int corner);
  /// Nothing is pending any more.
  void settle();

  Surface& surface_;
  std::vector<int> first_corner_, corners_;  ///< of each vertex: corners_[first_corner_[v], first_corner_[v + 1])
  std::vector<int> cluster_of_;              ///< (#corners)
  std::vector<int> leaf_of_, parent_;        ///< node of each cluster; parent of each node, -1 for the root
  std::vector<char> changed_;                ///< (#nodes)
  std::vector<int> pending_;                 ///< nodes whose box is to be refitted, children before parents once sorted
  double moved_m_ = 0;                       ///< since the last refit: any corner, at most
};

/// Position of a surface in its cycle at both ends of a step, in frames: any numbers, taken modulo the number of
/// frames, at most one frame apart. Also the shift of the whole surface, m, and the sway, >= 0; 1: as described.
struct SurfaceMotion {
  double frame_before = 0, frame_after = 0;
  Eigen::Vector3d shift_before_W = Eigen::Vector3d::Zero(), shift_after_W = Eigen::Vector3d::Zero();
  double sway_before = 0, sway_after = 0;
  bool door_open = false;  ///< during the step
};

/// The motion over a part of the step, 0 <= from < to <= 1.
SurfaceMotion part_of(const SurfaceMotion& whole, int frames, double from, double to);

/// Position of a vertex of `description` at a frame and a sway, m: the reference for contact.
Eigen::Vector3d vertex_at(const SurfaceDescription& description, int vertex, double frame, double sway = 0);

/// Weights of the frames k - 1, k, k + 1, k + 2 at k + x.
std::array<double, 4> frame_weights(double x);

/// Normal curvature towards the unit tangent e, 1/m, positive where the wall is hollow as seen from the lumen.
double curvature_towards(const V3<double>& e, const Surface::Triangle& triangle, const V3<double>& a,
                         const V3<double>& b, const V3<double>& c);

}  // namespace ostium::core
