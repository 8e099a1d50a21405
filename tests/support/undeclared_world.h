#pragma once
/// How the world of a made-up set differs from its file.
#include <functional>

#include "tests/support/dice.h"
#include "tests/support/undeclared.h"

namespace ostium::synthetic {

struct World {
  std::vector<std::function<void(const data::Experiment&, boundary_value::Problem&)>> mechanics;
  std::vector<std::function<Eigen::Vector3d(const data::Experiment&, const Eigen::Vector3d&)>>
      picture;  ///< applied in order
};

/// Adds an effect of the library, or one outside it, by its kind.
void add_effect(const std::string& id, Dice& dice, Undeclared& u, World& world);

core::Section made_section(double from_mm, double to_mm, double EI, double GJ, double kg_per_m,
                           const Eigen::Vector2d& k_per_m, double radius_mm, double bore_mm);

}  // namespace ostium::synthetic
