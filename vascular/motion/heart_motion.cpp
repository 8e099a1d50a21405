#include "vascular/motion/heart_motion.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace ostium::vascular {

namespace {

using units::mm, units::degree;
constexpr double lateral_descent = 16.0 * mm;  // of the left groove
constexpr double right_surplus = 0.30;         // excess of the right groove over the left one: 21 mm
constexpr double base_twist = -2 * degree, apex_twist = 8 * degree;  // counter-clockwise as seen from the apex
constexpr double root_descent = 7.5 * mm;
constexpr double root_share = 0.8;  // of the shift of the whole heart
constexpr double root_radius = 17 * mm, root_influence = 45 * mm;

/// Shift of the whole heart, to the left and forward.
const Eigen::Vector3d whole_shift(4.2 * mm, 0, 1.5 * mm);

/// Motion towards the axis, mm, by fraction of the axis from the base.
double radial_contraction(double s) {
  const double at[] = {0, 0.075, 0.25, 0.5, 0.75, 0.95}, by[] = {3.6, 3.8, 3.6, 3.0, 2.8, 1.4};
  s = std::clamp(s, at[0], at[5]);
  int i = 0;
  while (i < 4 && at[i + 1] < s) ++i;
  const double t = smooth_step(at[i], at[i + 1], s);
  return mm * (by[i] + t * (by[i + 1] - by[i]));
}

}  // namespace

double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * t * (10 - 15 * t + 6 * t * t);
}

Eigen::Vector3d HeartMotion::root_displacement() const {
  return root_descent * (marks_.p_lv_apex - marks_.p_lv_base).normalized() + root_share * whole_shift;
}

Eigen::Vector3d HeartMotion::displacement(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d axis = marks_.p_lv_apex - marks_.p_lv_base, along = axis.normalized();
  const double s = (p - marks_.p_lv_base).dot(along) / axis.norm();
  const Eigen::Vector3d across = p - marks_.p_lv_base - (p - marks_.p_lv_base).dot(along) * along;
  const double radius = across.norm();
  // Regularised on the axis, where the radial direction is undefined.
  const Eigen::Vector3d outwards = across / std::sqrt(radius * radius + 64 * mm * mm);

  const double right = (1 + outwards.dot(marks_.right_groove)) / 2;
  const double descent = lateral_descent * (1 + right_surplus * right * right * right);
  const double below = std::clamp(1 - s, 0.0, 1.0), above = 1 - smooth_step(0.15, 0.75, -s);
  const double axial = descent * (s > 0 ? std::pow(below, 1.1) : above);
  const double inwards = radial_contraction(s) * above;
  // Seen from the apex, i.e. against `along`.
  const double twist = base_twist + (apex_twist - base_twist) * std::clamp(s, 0.0, 1.0);
  const Eigen::Vector3d sideways = above * twist * across.cross(along);
  const Eigen::Vector3d of_wall = axial * along - inwards * outwards + sideways + above * whole_shift;

  // Near the root, the root's own motion takes over.
  const double height = std::clamp((p - marks_.p_annulus).dot(marks_.root_axis), 0.0, 25 * mm);
  const double from_root = (p - marks_.p_annulus - height * marks_.root_axis).norm();
  const double share = smooth_step(root_radius, root_influence, from_root);
  return share * of_wall + (1 - share) * root_displacement();
}

Eigen::Vector3d HeartMotion::breath_displacement(const Eigen::Vector3d& p, double depth) const {
  const Eigen::Vector3d turn(1.5 * degree, 0, 0);  // front towards the head
  const Eigen::Vector3d shift(0, -4.9 * mm, 1.3 * mm);
  const Eigen::Vector3d middle = (marks_.p_lv_base + marks_.p_lv_apex) / 2;
  return depth * (shift - turn.cross(p - middle));
}

}  // namespace ostium::vascular
