#pragma once
/// Vessels that wind, taper and divide, from a seed. Frame P, metres.
#include <string>
#include <vector>

#include "fluoro/phantom/random.h"
#include "fluoro/phantom/shapes.h"

namespace ostium::fluoro::phantom {

inline constexpr double course_step_m = 0.5e-3;  ///< between points of a course, nearly

struct Course {
  std::string name;
  bool left = true;
  Eigen::Matrix3Xd line;     ///< from the ostium, or from the parent's axis
  Eigen::VectorXd radius_m;  ///< at each point
  int parent = -1;           ///< which course of the list it leaves; -1: none
};

/// Outwards from the tissue that vessels lie on, at p; zero length: they run within it.
using Normal = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;
/// The place nearest to p where a vessel may lie.
using Bed = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

/// Sways the line beside its way, in waves of 6 to 35 mm of about that amplitude; its first point stays.
void wind(Eigen::Matrix3Xd& line, const Normal& normal, double amplitude_m, Random& random);

struct Growth {
  Eigen::Vector3d start, direction, goal;  ///< where it comes from, and the direction it strives for
  double length_m = 0;
  double curl_1_m = 150;  ///< standard deviation of its curvature
};
/// A line that strays and returns.
Eigen::Matrix3Xd grow(const Growth& growth, const Normal& normal, const Bed& bed, Random& random);

/// Diameters (mm) by share of the length, joined smoothly, with walls that are not quite even; wider at its mouth by
/// `flare` of its radius.
Eigen::VectorXd calibre(Eigen::Index points, const std::vector<std::pair<double, double>>& share_mm, double flare,
                        Random& random);

/// Where the lumen of a course is, as a distance: negative inside.
double from_course(const Course& course, const Eigen::Vector3d& p);

/// Its lumen as a closed surface, with fewer points and sides the thinner it is; begins on the walls of its parent and
/// of the siblings listed before it. `point` gives each vertex' point of course.line.
struct Lumen {
  Surface surface;
  Eigen::VectorXi point;
};
Lumen lumen(const std::vector<Course>& courses, std::size_t which);

}  // namespace ostium::fluoro::phantom
