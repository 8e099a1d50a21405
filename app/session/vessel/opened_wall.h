#pragma once
/// The wall that a session's instruments meet, as balloons, stents and drugs have left it.
///
/// SessionState::wall_m says which radius contact's wall has in each cell; the wall is a function of that alone. It
/// follows the lumen in small moves, a cell at a time: each costs its vertices in all frames of the beat, so a vessel
/// that opens is spread over many steps, and one that stays as it is costs nothing.
#include "app/session/vessel/vessel.h"

namespace ostium::app {

inline constexpr double wall_follows_m = 0.02e-3;   ///< what the lumen may be ahead by, where there is plaque,
inline constexpr double wall_follows_share = 0.03;  ///< and elsewhere, as a share of the radius
inline constexpr int wall_cells_a_step = 2;         ///< most that move in a step

/// Lets contact's radii follow those of the lumen, from `cursor` on, which it moves. All (#cells).
void follow_lumen(const vascular::FlowTree& tree, const std::vector<double>& radius_m, int& cursor,
                  std::vector<double>& wall_m);

class OpenedWall {
 public:
  /// Keeps references; `surface` is a copy of the vessel's own, and is changed.
  OpenedWall(const Vessel& vessel, core::Surface& surface);
  /// Makes the surface that of these radii.
  void set(const std::vector<double>& wall_m);

 private:
  const Coronaries& coronaries_;
  core::SurfaceEditor editor_;
  std::vector<double> now_m_;
  std::vector<int> changed_;
};

/// A vertex of that wall in a frame of the beat and a depth of breath, for those who judge: as contact has it, in
/// double precision.
Eigen::Vector3d wall_vertex(const Vessel& vessel, const std::vector<double>& wall_m, int vertex, double frame,
                            double breath);

}  // namespace ostium::app
