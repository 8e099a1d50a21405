#pragma once
/// One experiment as the static solver takes it: what the set declares, with what a fit or an effect changes in it.
#include "core/concentric/concentric.h"
#include "data/identification/measurement/measurement_set.h"

namespace ostium {

struct Effect;

/// An effect that is switched on.
struct ActiveEffect {
  const Effect* effect = nullptr;
  std::optional<int> instrument;  ///< none: all that it can act on
  std::vector<double> values;     ///< of effect->parameters
  std::vector<bool> held;         ///< of effect->parameters: not to be fitted; empty: none is
  std::string form;               ///< "" if there is one only

  std::string name() const;  ///< "rest_curvature[1] (section 2)"
};

/// What differs from the declaration.
struct Changes {
  std::vector<std::vector<double>> stiffness_scale;  ///< per instrument and section; empty: 1
  std::vector<ActiveEffect> effects;
};

struct Setup {
  ConcentricDescription nest;
  EndState base;  ///< unrolled
  Eigen::Vector3d gravity_m_s2 = Eigen::Vector3d::Zero(), tip_force_N = Eigen::Vector3d::Zero();
  /// By how much the directors that the sections are given in are turned about d3 against the instrument's own.
  double material_turn_rad = 0;
  std::optional<double> wall_friction;  ///< none: as the set declares it
  double wall_stiffness_N_m2 = 0;       ///< 0: rigid; core/surface/surface.h
};

/// Of a rod's elements, m: 1.5 mm is half a micrometre from a boundary-value solution on tubes; twice that is a few,
/// enough to compare models by.
inline constexpr double fine_elements_m = 1.5e-3, coarse_elements_m = 3e-3;

/// `longest_element_m`: no element is longer. Throws LoadError naming the experiment where changed numbers make no rod
/// any more.
Setup setup_of(const MeasurementSet& set, const Experiment& experiment, const Changes& changes,
               double longest_element_m = fine_elements_m);

/// Refuses what the models do not know: in a vessel, a base that moves, shafts that twist, specimens, an innermost
/// instrument that ends within another; and a vessel that was not read (load_measurement reads it).
void require_known(const MeasurementSet& set);

}  // namespace ostium
