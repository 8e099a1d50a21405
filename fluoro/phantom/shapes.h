#pragma once
/// Closed surfaces from closed forms, for fluoro's tests and pictures. Frame P, metres.
#include <functional>

#include "fluoro/matter/scene.h"

namespace ostium::fluoro::phantom {

struct Surface {
  std::shared_ptr<const Triangles> triangles;
  Eigen::Matrix3Xf p_P;
};

/// The star-shaped region within radius(direction) of `centre`, for unit vectors: 4 rings^2 triangles, poles along
/// `axis`.
Surface star(const Eigen::Vector3d& centre, const std::function<double(const Eigen::Vector3d&)>& radius, int rings,
             const Eigen::Vector3d& axis = Eigen::Vector3d::UnitY());

/// Semi-axes along the columns of `axes`. A larger exponent is boxier: 2 is an ellipsoid, 6 almost a brick.
Surface ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& semi_axes, int rings,
                  const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity(), double exponent = 2);

/// A brick; two opposite faces can represent a slab.
Surface brick(const Eigen::Vector3d& least, const Eigen::Vector3d& most);

/// A tube around a line, with flat or round ends: `radius_m` at each point; scaled by `flatness` across `normal`.
Surface tube(const Eigen::Matrix3Xd& line, const Eigen::VectorXd& radius_m, int sides, bool round_ends = true,
             double flatness = 1, const Eigen::Vector3d& normal = Eigen::Vector3d::UnitY());
/// For each of the tube's vertices, its point on the line, and that point's position.
Eigen::VectorXi tube_points(Eigen::Index points, int sides, bool round_ends = true);
Eigen::Matrix3Xf tube_centres(const Eigen::Matrix3Xd& line, int sides, bool round_ends = true);

/// Signed distance to a surface, exact or approximate: negative inside.
using Distance = std::function<double(const Eigen::Vector3d&)>;
/// Makes a tube with round ends begin on its parent's surface: the part of its sides that is `within` the parent
/// becomes a lid on that surface, so that path lengths of both add up to those of their union. Only the first `longest`
/// rings are tested.
void begin_outside(Surface& tube, int sides, Eigen::Index longest, const Distance& within);

/// The zero level of `inside` (negative inside, positive at the border of the box), by surface nets on cells of
/// `cell_m` (Gibson, MERL 1999), projected onto the zero.
Surface net(const Distance& inside, const Eigen::Vector3d& low, const Eigen::Vector3d& high, double cell_m);
/// Minimum or maximum of two distances, with the crevice or edge between them rounded over `k`.
double joined(double a, double b, double k);
double common(double a, double b, double k);
/// Signed distance of p from a round rod whose radius may vary along its length.
double from_rod(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius_a,
                double radius_b);

/// A smooth line through the points (Catmull-Rom), with a point every `spacing_m`.
Eigen::Matrix3Xd smooth_line(const std::vector<Eigen::Vector3d>& through, double spacing_m);

Body body(const std::string& name, const Surface& surface, Tissue inside, Tissue within);

}  // namespace ostium::fluoro::phantom
