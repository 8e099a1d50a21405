#pragma once
/// A stent's points and struts in the patient frame: on its balloon, or moving with the wall.
#include "vascular/treatment/stent.h"
#include "vascular/treatment/wall_shape.h"

namespace ostium::vascular {

/// Struts and links, as pairs of points.
std::vector<std::pair<int, int>> struts_of(const StentModel& model);

/// Centre of the path and two transverse directions, transported along it without twist.
struct PathFrame {
  Eigen::Vector3d centre, along, side, up;
};
PathFrame frame_at(const LumenMap& map, const VesselPath& path, double s_m, double phase, double breath = 0);

/// Positions of its points from the path alone.
std::vector<Eigen::Vector3d> points_on_path(const StentModel& model, const StentState& state, const LumenMap& map,
                                            const VesselPath& path, double phase, double breath = 0);

/// Attaches a deployed stent to the wall, both in their present shape; once, between two steps. `gap_m`: from each
/// point to the wall.
void tie_to_wall(const StentModel& model, const Patient& patient, const WallShape& shape, const LumenMap& map,
                 const VesselPath& path, const PlaqueState& wall, double phase, StentState& state);
bool is_tied(const StentState& state);

/// Positions of the attached points at a phase.
std::vector<Eigen::Vector3d> points_on_wall(const StentModel& model, const StentState& state, const Patient& patient,
                                            const WallShape& shape, std::span<const double> radius_m, double phase,
                                            double breath);

/// Gap between the middle of a strut at each point and the wall's surface, less half its thickness: 0 is contact.
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
