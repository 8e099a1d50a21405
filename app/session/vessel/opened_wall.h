#pragma once
/// The wall that instruments meet in a session, as changed by balloons, stents and drugs, and as pushed aside.
///
/// The wall is a function of SessionState::wall_m and wall_aside_P alone, the radius of contact's wall in each cell and
/// how far it lies aside. It follows the lumen in small moves, one cell at a time, because each move updates the cell's
/// vertices in all frames of the beat: opening a vessel is spread over many steps, and an unchanged one costs nothing.
/// Where arteries give way, all cells follow at once, by a little.
#include "app/session/vessel/vessel.h"

namespace ostium::app {

inline constexpr double wall_follows_m = 0.02e-3;   ///< allowed lag behind the lumen where there is plaque,
inline constexpr double wall_follows_share = 0.03;  ///< and elsewhere, relative to the radius
inline constexpr int wall_cells_a_step = 1;         ///< cells moved per step, at most
inline constexpr double aside_follows_m = 4e-6;     ///< allowed lag behind an artery that gives way, and how far the
inline constexpr double aside_step_m = 5e-6;        ///< wall follows at once, at most: it may come back at instruments

/// Makes contact's radii follow the lumen's, starting at `cursor`, which it advances. All (#cells).
void follow_lumen(const vascular::FlowTree& tree, const std::vector<double>& radius_m, int& cursor,
                  std::vector<double>& wall_m);

/// Makes contact's wall follow arteries that give way. Both (#cells).
void follow_aside(const std::vector<Eigen::Vector3d>& aside_P, std::vector<Eigen::Vector3d>& wall_aside_P);

/// Whether the wall differs from the vessel's own. `wall_m`: (#cells); `wall_aside_P`: also empty.
bool is_opened(const Vessel& vessel, const std::vector<double>& wall_m);
bool is_aside(const std::vector<Eigen::Vector3d>& wall_aside_P);

class OpenedWall {
 public:
  /// Keeps references; `surface` is a copy of the vessel's own, and is modified.
  /// `yields`: arteries give way.
  OpenedWall(const Vessel& vessel, core::Surface& surface, bool yields);
  /// Updates the surface.
  void set(const std::vector<double>& wall_m, const std::vector<Eigen::Vector3d>& wall_aside_P);

 private:
  void open(const std::vector<double>& wall_m);
  void move_aside(const std::vector<Eigen::Vector3d>& wall_aside_P);
  void list(const CellVertices& of_cells, std::size_t cell);

  const Coronaries& coronaries_;
  core::SurfaceEditor editor_;
  std::vector<double> now_m_;
  std::vector<Eigen::Vector3d> now_aside_P_;
  std::vector<int> listed_;      ///< vertices to be moved
  std::vector<char> is_listed_;  ///< (#vertices)
  Eigen::Matrix3Xf placed_;      ///< (3, #vertices)
};

/// A vertex of that wall, as contact has it but in double precision, for penetration checks.
Eigen::Vector3d wall_vertex(const Vessel& vessel, const std::vector<double>& wall_m, int vertex,
                            const vascular::LumenMoment& moment);

}  // namespace ostium::app
