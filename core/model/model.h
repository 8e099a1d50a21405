#pragma once
/// Everything about a simulation that does not change while it runs. Const after loading; shared freely by threads.
#include <memory>
#include <vector>

#include "core/model/nesting.h"
#include "core/model/rod.h"
#include "core/wall/surface.h"

namespace ostium::core {

struct Model {
  std::vector<Rod> rods;
  std::vector<Nesting> nestings;
  std::vector<std::shared_ptr<const Surface>> surfaces;  ///< the walls; instruments are inside them
  bool rods_touch = false;  ///< rods touch each other where neither runs in the other, and themselves
  bool sweep = true;        ///< contact sees all of a step; false: what is touched as it begins. For a test alone
  Eigen::Vector3d gravity_W = Eigen::Vector3d(0, 0, -9.81);  ///< m/s2
  double step_s = 1e-3;                                      ///< (0, 0.01]
};

/// Throws std::invalid_argument if there is no rod, gravity is not finite, the step is out of range, or a nesting names
/// rods that there are not, an outer rod behind its inner one, more than three outer rods around one at
/// once, or an inner rod too thick for the lumen. Rods of which neither runs in the other, each in the same outer one
/// (balloons for one wire), are alternatives: one of them is in the body, or the second is nested in nothing.
void check(const Model& model);

}  // namespace ostium::core
