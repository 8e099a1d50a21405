#pragma once
/// Everything about a simulation that does not change while it runs. Const after loading; shared freely by threads.
#include <vector>

#include "core/rod/rod.h"

namespace ostium {

struct Model {
  std::vector<Rod> rods;
  Eigen::Vector3d gravity_W = Eigen::Vector3d(0, 0, -9.81);  ///< m/s2
  double step_s = 1e-3;                                      ///< (0, 0.01]
};

/// Throws std::invalid_argument if there is no rod, gravity is not finite or the step is out of range.
void check(const Model& model);

}  // namespace ostium
