#pragma once
/// What makes a chest differ from the next and its shadow uneven: fat between muscles and about the heart, gas in the
/// stomach and the colon. Sizes are estimates, after chest CT as usually seen.
#include <functional>

#include "vascular/thorax/thorax.h"

namespace ostium::vascular {

class Draws;

/// Lobules of fat in the chest's wall between two ellipses (half axes in x and z at a height, mm), about `middle_x_mm`.
struct ChestWall {
  double middle_x_mm = 0;
  std::function<Eigen::Vector2d(double y_mm)> inner_mm, outer_mm;
};
XrayBody wall_fat(const ChestWall& wall, int lobules, Draws& draw);

/// Lobules on the heart's surface, those in the grooves thicker; `heart`: distance in m.
XrayBody heart_fat(const std::function<double(const Eigen::Vector3d&)>& heart, const Eigen::AlignedBox3d& box,
                   int lobules, Draws& draw);

/// Gas below the left dome of the diaphragm, whose height is given in mm.
XrayBody stomach_gas(const std::function<double(double x_mm, double z_mm)>& dome_mm, Draws& draw);

}  // namespace ostium::vascular
