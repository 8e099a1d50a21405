#pragma once
/// A stent's points and struts in the patient frame: on its balloon, or moving with the wall.
#include <functional>

#include "vascular/treatment/stent.h"
#include "vascular/treatment/wall_shape.h"

namespace ostium::vascular {

/// Struts and links, as pairs of points.
std::vector<std::pair<int, int>> struts_of(const StentModel& model);

/// Centre of the path and two transverse directions, transported along it without twist.
struct PathFrame {
  Eigen::Vector3d centre, along, side, up;
};
PathFrame frame_at(const LumenMap& map, const VesselPath& path, double s_m, const LumenMoment& moment);
/// Its centre and direction alone, which take no way along the path.
struct PathPoint {
  Eigen::Vector3d centre, along;
};
PathPoint point_at(const LumenMap& map, const VesselPath& path, double s_m, const LumenMoment& moment);

/// The same for many places: goes on from the first of them instead of from the path's beginning. Keeps references.
class PathFrames {
 public:
  /// `least_m`: no place lies before it.
  PathFrames(const LumenMap& map, const VesselPath& path, double least_m, const LumenMoment& moment);
  PathFrame at(double s_m) const;
  /// That, and later places are no longer before it.
  PathFrame go_to(double s_m);

 private:
  Eigen::Vector3d centre(int i) const;
  /// Carries the side direction to cell `to` of the path.
  void carry(int& index, int to, Eigen::Vector3d& along, Eigen::Vector3d& side) const;

  const LumenMap& map_;
  const VesselPath& path_;
  LumenMoment moment_;
  int first_ = -1;
  Eigen::Vector3d along_, side_;  ///< at cell `first_`
};

/// Position of one of its points from the path alone; `frames` begins at or before it.
Eigen::Vector3d point_on_path(const StentModel& model, const StentState& state, const PathFrames& frames, int point);
/// That of all of them; `aside_m`, if there is one: how far the stent lies aside at a position, along side and up.
std::vector<Eigen::Vector3d> points_on_path(const StentModel& model, const StentState& state, const LumenMap& map,
                                            const VesselPath& path, const LumenMoment& moment,
                                            const std::function<Eigen::Vector2d(double s_m)>& aside_m = {});

/// Whether every point is attached to the wall (stent_ties.h).
bool is_tied(const StentState& state);

/// Positions of the attached points at a moment.
std::vector<Eigen::Vector3d> points_on_wall(const StentModel& model, const StentState& state, const Patient& patient,
                                            const WallShape& shape, std::span<const double> radius_m,
                                            const LumenMoment& moment);

/// Gap between the middle of a strut at one point and the wall's surface, less half its thickness. A stent too small
/// for its vessel lies against one side: its gap is 0 there, and twice the mean on the opposite side. One that is not
/// round leaves a gap where it is narrow.
double gap_of(const StentModel& model, const StentState& state, const VesselPath& path, const PlaqueState& wall,
              int point);
/// That of each point: 0 is contact.
std::vector<double> gaps(const StentModel& model, const StentState& state, const VesselPath& path,
                         const PlaqueState& wall);

inline constexpr double apposed_m = 0.05e-3;  ///< largest gap that counts as apposed
struct Apposition {
  double share = 1;    ///< share of apposed points
  double worst_m = 0;  ///< largest gap
};
/// Does not allocate.
Apposition apposition(const StentModel& model, const StentState& state, const VesselPath& path,
                      const PlaqueState& wall);

}  // namespace ostium::vascular
