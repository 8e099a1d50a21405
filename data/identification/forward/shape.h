#pragma once
/// The static shapes of a set's experiments.
#include <functional>

#include "data/identification/forward/setup.h"

namespace ostium::data {

/// A centreline in the set's frame.
struct PredictedShape {
  bool converged = false;
  std::vector<Eigen::Vector3d> points_m;                ///< base to the innermost tip
  Eigen::Vector4d tip_q = Eigen::Vector4d(1, 0, 0, 0);  ///< frame of the innermost tip, w x y z
  double base_push_N = 0;                               ///< axial force that holds it at the base
  /// What the views after the first see, where an effect lets them see another shape; else empty.
  std::vector<std::vector<Eigen::Vector3d>> later_views_m = {};
};

/// An experiment's equilibrium, used as a starting point.
struct StaticEquilibrium {
  core::Concentric nest;
  core::ConcentricState state;
  bool converged = false;
};

/// Finds the equilibrium of `setup` that continues from `anchor.state`.
PredictedShape shape_from(const ExperimentSetup& setup, const StaticEquilibrium& anchor);
/// The same, and returns the equilibrium as a starting point for nearby setups.
PredictedShape shape_from(const ExperimentSetup& setup, const StaticEquilibrium& anchor, StaticEquilibrium& end);

/// Adds what the later views see, if an effect parts the views; `anchor` is near the first one's equilibrium.
void add_later_views(const MeasurementSet& set, const Experiment& experiment, const Changes& changes,
                     double longest_element_m, const StaticEquilibrium& anchor, PredictedShape& shape);

/// The equilibria of all experiments in listed order, each reached from the one before by small steps in insertion,
/// roll, base and load; the first one starts straight. `progress(done, of)` may be empty.
std::vector<StaticEquilibrium> walk(const MeasurementSet& set, const Changes& changes,
                                    const std::function<void(std::size_t, std::size_t)>& progress = {},
                                    double longest_element_m = fine_elements_m);

}  // namespace ostium::data
