#pragma once
/// Everything about a simulation that does not change while it runs. Constant after loading; shared freely by threads.
#include <memory>
#include <vector>

#include "core/model/nesting.h"
#include "core/model/rod.h"
#include "core/wall/surface.h"

namespace ostium::core {

struct Model {
  std::vector<Rod> rods;
  std::vector<Nesting> nestings;
  std::vector<std::shared_ptr<const Surface>> surfaces;  ///< the walls, with the instruments inside
  bool rods_touch = false;  ///< contact between rods that are not nested, and of a rod with itself
  int fork_from = 2;        ///< rods side by side that leave one lumen from which on its chain forks. 1: for a test
  bool sweep = true;        ///< continuous collision; false: only walls touched at the start of a step. For a test
  Eigen::Vector3d gravity_W = Eigen::Vector3d(0, 0, -9.81);  ///< m/s2
  double step_s = 1e-3;                                      ///< (0, 0.01]
};

/// Throws std::invalid_argument if there is no rod, gravity is not finite, the step is out of range, or a nesting names
/// missing rods, an outer rod after its inner one, more than three outer rods around one at once, or an inner rod too
/// thick for the lumen. Two rods that are not nested in each other but in the same outer rod lie side by side in its
/// lumen (two wires in a guide). Of two such rods around the same third one (balloons for one wire), the third is in
/// the last that is in the body.
void check(const Model& model);

}  // namespace ostium::core
