#pragma once
/// The wall that instruments meet in a session, as changed by balloons, stents and drugs.
///
/// The wall is a function of SessionState::wall_m alone, the radius of contact's wall in each cell. It follows the
/// lumen in small moves, one cell at a time, because each move updates the cell's vertices in all frames of the beat:
/// opening a vessel is spread over many steps, and an unchanged one costs nothing.
#include "app/session/vessel/vessel.h"

namespace ostium::app {

inline constexpr double wall_follows_m = 0.02e-3;   ///< allowed lag behind the lumen where there is plaque,
inline constexpr double wall_follows_share = 0.03;  ///< and elsewhere, relative to the radius
inline constexpr int wall_cells_a_step = 1;         ///< cells moved per step, at most

/// Makes contact's radii follow the lumen's, starting at `cursor`, which it advances. All (#cells).
void follow_lumen(const vascular::FlowTree& tree, const std::vector<double>& radius_m, int& cursor,
                  std::vector<double>& wall_m);

/// Whether the wall differs from the vessel's own. `wall_m`: (#cells).
bool is_opened(const Vessel& vessel, const std::vector<double>& wall_m);

class OpenedWall {
 public:
  /// Keeps references; `surface` is a copy of the vessel's own, and is modified.
  OpenedWall(const Vessel& vessel, core::Surface& surface);
  /// Updates the surface to these radii.
  void set(const std::vector<double>& wall_m);

 private:
  const Coronaries& coronaries_;
  core::SurfaceEditor editor_;
  std::vector<double> now_m_;
  std::vector<int> changed_;
};

/// A vertex of that wall in a frame of the beat and a depth of breath, as contact has it but in double precision, for
/// penetration checks.
Eigen::Vector3d wall_vertex(const Vessel& vessel, const std::vector<double>& wall_m, int vertex, double frame,
                            double breath);

}  // namespace ostium::app
