#pragma once
/// Closed surfaces from closed forms, for fluoro's tests and pictures. Frame P, metres.
#include <functional>

#include "fluoro/matter/scene.h"

namespace ostium::fluoro::phantom {

struct Surface {
  std::shared_ptr<const Triangles> triangles;
  Eigen::Matrix3Xf p_P;
};

/// What lies nearer to `centre` than radius(direction), a unit vector: 4 rings^2 triangles, poles along `axis`.
Surface star(const Eigen::Vector3d& centre, const std::function<double(const Eigen::Vector3d&)>& radius, int rings,
             const Eigen::Vector3d& axis = Eigen::Vector3d::UnitY());

/// Semi-axes along the columns of `axes`. The exponent makes it boxier: 2 is an ellipsoid, 6 nearly a brick.
Surface ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& semi_axes, int rings,
                  const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity(), double exponent = 2);

/// A brick; two opposite faces may be planes of a slab.
Surface brick(const Eigen::Vector3d& least, const Eigen::Vector3d& most);

/// A tube round a line, flat or round at its ends: `radius_m` at each point, across `normal` scaled by `flatness`.
Surface tube(const Eigen::Matrix3Xd& line, const Eigen::VectorXd& radius_m, int sides, bool round_ends = true,
             double flatness = 1, const Eigen::Vector3d& normal = Eigen::Vector3d::UnitY());
/// Which point of the line each of the tube's vertices belongs to, and where that is.
Eigen::VectorXi tube_points(Eigen::Index points, int sides, bool round_ends = true);
Eigen::Matrix3Xf tube_centres(const Eigen::Matrix3Xd& line, int sides, bool round_ends = true);

/// Distance to a surface, or nearly: negative inside.
using Distance = std::function<double(const Eigen::Vector3d&)>;
/// Lets a tube with round ends begin on the surface of what it leaves: what its sides have `within` becomes a lid on
/// that surface, so that path lengths of both add up to those of their union. Only the first `longest` rings are asked.
void begin_outside(Surface& tube, int sides, Eigen::Index longest, const Distance& within);

/// Where `inside` is negative, by surface nets on cells of `cell_m` (Gibson, MERL 1999), drawn onto its zero; it is
/// positive at the border of the box.
Surface net(const Distance& inside, const Eigen::Vector3d& low, const Eigen::Vector3d& high, double cell_m);
/// The lesser, or the greater, of two distances, with the crevice or the edge between them rounded over `k`.
double joined(double a, double b, double k);
double common(double a, double b, double k);
/// From a round rod, thinner or thicker along its way, to p.
double from_rod(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius_a,
                double radius_b);

/// A smooth line through `through` (Catmull-Rom), a point every `spacing_m`.
Eigen::Matrix3Xd smooth_line(const std::vector<Eigen::Vector3d>& through, double spacing_m);

Body body(const std::string& name, const Surface& surface, Tissue inside, Tissue within);

}  // namespace ostium::fluoro::phantom
