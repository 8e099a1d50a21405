#pragma once
/// How the world of a synthetic set differs from its file, and the ways in which it may: noise that is not as declared,
/// faults of the data, laws of another form than those of the library.
#include <functional>
#include <vector>

#include "tests/support/dice.h"
#include "tests/support/sets/undeclared.h"

namespace ostium::synthetic {

struct World {
  std::vector<std::function<void(const data::Experiment&, boundary_value::Problem&)>> mechanics;
  std::vector<std::function<Eigen::Vector3d(const data::Experiment&, const Eigen::Vector3d&)>> picture;  ///< in order
};

/// "taper", "torsion_ratio", "level", "reclamping", "form:anisotropy_by_section", "form:softening_by_moment": changes
/// the world and notes what is right. False: it is none of these.
bool add_form(const std::string& id, Dice& dice, Undeclared& made, World& world);

/// "fault:...": draws whose fault it is, and changes the world where the fault is one of handling.
void add_fault(const std::string& id, Dice& dice, Undeclared& made, World& world);
/// Writes the measured set wrongly where the fault is one of writing; after noise was added.
void write_wrongly(const std::string& id, Undeclared& made);

/// "noise:shared" (25 mm along the wire), "noise:smooth" (a Gaussian window as wide), "noise:heavy" (Student's t of 3),
/// "noise:blunders" (3 % of points), "noise:twice", or "" for what is declared: adds it to the points.
void add_noise(const std::string& id, Dice& dice, double sigma_m, std::vector<Eigen::Vector3d>& points_m);

/// Adds an effect of the library, or one outside it, by its kind.
void add_effect(const std::string& id, Dice& dice, Undeclared& u, World& world);

core::Section made_section(double from_mm, double to_mm, double EI, double GJ, double kg_per_m,
                           const Eigen::Vector2d& k_per_m, double radius_mm, double bore_mm);

}  // namespace ostium::synthetic
