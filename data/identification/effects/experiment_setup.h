#pragma once
/// One experiment as input to the forward models.
#include <optional>

#include "core/concentric_tubes/concentric.h"

namespace ostium::data {

struct ExperimentSetup {
  core::ConcentricDescription nest;
  core::EndState base;  ///< before any roll
  Eigen::Vector3d gravity_m_s2 = Eigen::Vector3d::Zero(), tip_force_N = Eigen::Vector3d::Zero();
  /// Angle about d3 from the instrument's own directors to the directors in which the sections are given.
  double material_turn_rad = 0;
  int view = 0;                         ///< of a set of projections: the view that sees the shape
  std::optional<double> wall_friction;  ///< none: as declared in the set
  double wall_stiffness_N_m2 = 0;       ///< 0: rigid; see core/wall/surface.h
};

}  // namespace ostium::data
