#pragma once
/// Winding, tapering and branching vessels, generated from a seed. Frame P, metres.
#include <string>
#include <vector>

#include "fluoro/phantom/random.h"
#include "fluoro/phantom/shapes.h"

namespace ostium::fluoro::phantom {

inline constexpr double course_step_m = 0.5e-3;  ///< approximate spacing of a course's points

struct Course {
  std::string name;
  bool left = true;
  Eigen::Matrix3Xd line;     ///< from the ostium, or from the parent's axis
  Eigen::VectorXd radius_m;  ///< at each point
  int parent = -1;           ///< index of the course it branches from; -1: none
};

/// Outward normal of the tissue surface on which vessels lie, at p; zero length: they run inside it.
using Normal = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;
/// The point nearest to p where a vessel may lie.
using Bed = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

/// Makes the line sway sideways in waves of 6 to 35 mm with about that amplitude; its first point stays.
void wind(Eigen::Matrix3Xd& line, const Normal& normal, double amplitude_m, Random& random);

struct Growth {
  Eigen::Vector3d start, direction, goal;  ///< where it starts, its direction, and the direction it tends to
  double length_m = 0;
  double curl_1_m = 150;  ///< standard deviation of its curvature
};
/// A line that wanders but returns to its goal direction.
Eigen::Matrix3Xd grow(const Growth& growth, const Normal& normal, const Bed& bed, Random& random);

/// Diameters (mm) by share of the length, interpolated smoothly with slightly uneven walls; the mouth is wider by
/// `flare` of its radius.
Eigen::VectorXd calibre(Eigen::Index points, const std::vector<std::pair<double, double>>& share_mm, double flare,
                        Random& random);

/// Signed distance from a course's lumen: negative inside.
double from_course(const Course& course, const Eigen::Vector3d& p);

/// Its lumen as a closed surface, with fewer points and sides the thinner it is; it begins on the walls of its parent
/// and of the siblings listed before it. `point` gives each vertex's point of course.line.
struct Lumen {
  Surface surface;
  Eigen::VectorXi point;
};
Lumen lumen(const std::vector<Course>& courses, std::size_t which);

}  // namespace ostium::fluoro::phantom
