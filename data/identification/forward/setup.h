#pragma once
/// One experiment as the static solver takes it: what the set declares, with what a fit or an effect changes in it.
#include "data/identification/effects/effect.h"

namespace ostium::data {

/// Of a rod's elements, m: 1.5 mm is half a micrometre from a boundary-value solution on tubes; twice that is a few,
/// enough to compare models by.
inline constexpr double fine_elements_m = 1.5e-3, coarse_elements_m = 3e-3;

/// `longest_element_m`: no element is longer. Throws LoadError naming the experiment where changed numbers make no rod
/// any more.
ExperimentSetup setup_of(const MeasurementSet& set, const Experiment& experiment, const Changes& changes,
                         double longest_element_m = fine_elements_m);

/// Refuses what the models do not know: in a vessel, a base that moves, shafts that twist, specimens, an innermost
/// instrument that ends within another; and a vessel that was not read (load_measurement reads it).
void require_known(const MeasurementSet& set);

}  // namespace ostium::data
