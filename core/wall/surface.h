#pragma once
/// A wall: triangles that move through the frames of a cycle. Const once made; the truth that contact is tested
/// against.
///
/// Between frames a vertex moves on a periodic Catmull-Rom spline, so its velocity is continuous. Triangles lie in
/// clusters of up to 16, the leaves of a tree of boxes. The boxes hold what is in them during a whole interval between
/// two frames (they are those of the spline's Bezier points), so they are made once and never refitted; positions are
/// computed in clusters near an instrument alone. A slow motion beside the cycle, of a rhythm of its own, is a second
/// set of displacements (`sway`), which is added times one number; each box has that of its corners' displacements.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/math/huge_pages.h"
#include "core/math/lanes.h"

namespace ostium::core {

struct SurfaceDescription {
  /// Vertices, m: one frame if it stands still; else those of one cycle, evenly spaced in time.
  std::vector<std::vector<Eigen::Vector3d>> frames;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise as seen from outside of the lumen
  /// (#vertices), m: how far each is displaced at a sway of 1, in all frames alike. Empty: it does not sway.
  std::vector<Eigen::Vector3d> sway;
  /// Force per length of instrument and depth, N/m2, that pushes the wall outwards; 0: rigid.
  double stiffness_N_m2 = 0;
  double friction = 0;  ///< against instruments, static and kinetic
  /// A door: triangles that instruments no thicker than this pass while it is open (SurfaceMotion), and that are a wall
  /// like any other else. It hangs within the lumen: without it the surface is closed.
  std::vector<int> door;
  double door_passes_m = 0;  ///< radius
};

inline constexpr int cluster_size = 16;  ///< triangles

struct Box {
  std::array<float, 3> low, high;
};

struct Surface {
  struct Cluster {
    int first_triangle = 0, triangles = 0;
    int first_corner = 0, corners = 0;  ///< its own copies of the vertices, in `corner_frames`
    bool stands_still = false;          ///< its corners are in one place in all frames
  };
  struct Node {    ///< of the tree, depth first: the first child follows its parent
    int skip = 0;  ///< where to go on when the box is missed
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
  /// [cluster][frame][x, y, z][corner of it], m: what is read together is together.
  std::vector<float, OnHugePages<float>> corner_frames;
  std::vector<float> corner_sway;         ///< [cluster][x, y, z][corner of it], m; empty: it does not sway
  std::vector<int> corner_vertex;         ///< [corner], as described
  std::vector<V3<float>> corner_normals;  ///< [corner], outwards, of the first frame: they tell sides, no more
  int corners = 0;
  std::vector<Node> nodes;
  std::vector<Box, OnHugePages<Box>> boxes;  ///< [interval][node]
  std::vector<Box> sway_boxes;               ///< [node], of displacements; empty: it does not sway
  double stiffness_N_m2 = 0, friction = 0, door_passes_m = 0;
  int largest_cluster = 0;  ///< corners
  long edits = 0;           ///< how often a SurfaceEditor changed it

  /// Where an axis of a cluster's corners begins in `corner_frames`.
  std::size_t row(const Cluster& c, int frame, int axis) const {
    return std::size_t{3} * frames * c.first_corner + std::size_t{1} * (3 * frame + axis) * c.corners;
  }
  /// The same in `corner_sway`.
  std::size_t sway_row(const Cluster& c, int axis) const {
    return std::size_t{3} * c.first_corner + std::size_t{1} * axis * c.corners;
  }
  bool sways() const { return !corner_sway.empty(); }
};

/// Throws std::invalid_argument if there is no triangle or frame, a triangle names a vertex that there is not, frames
/// differ in length (`sway` too), or a number is not finite or negative.
Surface make_surface(const SurfaceDescription& description);

/// Puts vertices of a surface elsewhere, for the whole cycle, and refits the boxes: walls that something opened. Its
/// triangles, clusters, normals, curvatures and sway stay. What the surface is then depends on the places alone, not on
/// the order in which they came about.
class SurfaceEditor {
 public:
  /// Keeps a reference. `description`: what the surface was made of.
  SurfaceEditor(const SurfaceDescription& description, Surface& surface);

  /// One vertex in one frame; call `refit` after the last.
  void place(int vertex, int frame, const Eigen::Vector3d& p_W);
  void refit();

 private:
  Surface& surface_;
  std::vector<int> first_corner_, corners_;  ///< of each vertex: corners_[first_corner_[v], first_corner_[v + 1])
  std::vector<int> cluster_of_;              ///< (#corners)
  std::vector<int> leaf_of_, parent_;        ///< node of a cluster; of a node, -1
  std::vector<char> changed_;                ///< (#nodes)
  std::vector<int> pending_;  ///< nodes whose box is to be made anew, children before parents once sorted
};

/// Where in its cycle a surface is at both ends of a step, in frames: any numbers, taken modulo the number of frames,
/// at most one frame apart. By how much all of it is shifted, m; and how far it sways, 0 or more: 1 is as described.
struct SurfaceMotion {
  double frame_before = 0, frame_after = 0;
  Eigen::Vector3d shift_before_W = Eigen::Vector3d::Zero(), shift_after_W = Eigen::Vector3d::Zero();
  double sway_before = 0, sway_after = 0;
  bool door_open = false;  ///< during the step
};

/// What it does from one part of the step to another, 0 <= from < to <= 1.
SurfaceMotion part_of(const SurfaceMotion& whole, int frames, double from, double to);

/// Position of a vertex of `description` at a moment of the cycle and a sway, m: what contact takes for the truth.
Eigen::Vector3d vertex_at(const SurfaceDescription& description, int vertex, double frame, double sway = 0);

/// Weights of the frames k - 1, k, k + 1, k + 2 at k + x.
std::array<double, 4> frame_weights(double x);

/// Normal curvature towards the unit tangent e, 1/m, positive where the wall is hollow as seen from the lumen.
double curvature_towards(const V3<double>& e, const Surface::Triangle& triangle, const V3<double>& a,
                         const V3<double>& b, const V3<double>& c);

}  // namespace ostium::core
