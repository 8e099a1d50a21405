#pragma once
/// One experiment as input to the static solver: as declared, with the changes of a fit or an effect.
#include "data/identification/effects/effect.h"

namespace ostium::data {

/// A frame that is kept as w, x, y, z.
inline Eigen::Quaterniond quaternion(const Eigen::Vector4d& wxyz) { return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]}; }

/// Element lengths of a rod, m: 1.5 mm agrees with a boundary-value solution for tubes to half a micrometre; twice that
/// to a few, which is enough to compare models.
inline constexpr double fine_elements_m = 1.5e-3, coarse_elements_m = 3e-3;

/// `longest_element_m`: limit on element length. `view`: the view that sees it, for effects that part the views. Throws
/// LoadError naming the experiment if the changed numbers do not describe a rod.
ExperimentSetup setup_of(const MeasurementSet& set, const Experiment& experiment, const Changes& changes,
                         double longest_element_m = fine_elements_m, int view = 0);

/// What to say where an experiment has no static shape: what was asked for, and what may be wrong with it.
std::string no_static_shape(const MeasurementSet& set, const Experiment& experiment, const ExperimentSetup& setup);

/// Refuses what the models cannot handle: in a vessel, a moving base, shafts that twist, specimens, or an innermost
/// instrument that ends inside another; and a vessel that was not read (load_measurement reads it).
void require_known(const MeasurementSet& set);

}  // namespace ostium::data
