#pragma once
/// The static shapes of a set's experiments.
#include <functional>

#include "data/identification/forward/setup.h"

namespace ostium {

/// A centreline, in the frame of the set.
struct Shape {
  bool converged = false;
  std::vector<Eigen::Vector3d> points_m;                ///< base to the innermost tip
  Eigen::Vector4d tip_q = Eigen::Vector4d(1, 0, 0, 0);  ///< frame of the innermost tip, w x y z
  double base_push_N = 0;                               ///< axial, what holds it at the base
};

/// An experiment's equilibrium, to continue from.
struct Anchor {
  Concentric nest;
  ConcentricState state;
  bool converged = false;
};

/// Brings `anchor.state` into the equilibrium of `setup` that continues from it.
Shape shape_from(const Setup& setup, const Anchor& anchor);
/// The same, and where it ended, for others near it to continue from.
Shape shape_from(const Setup& setup, const Anchor& anchor, Anchor& end);

/// The equilibria of all experiments in listed order, each reached from the one before by small steps in insertion,
/// roll, base and load, the first from straight. `progress(done, of)` may be empty.
std::vector<Anchor> walk(const MeasurementSet& set, const Changes& changes,
                         const std::function<void(std::size_t, std::size_t)>& progress = {},
                         double longest_element_m = fine_elements_m);

/// Nearest point of the curve, continued straight past its ends.
Eigen::Vector3d nearest_point(const std::vector<Eigen::Vector3d>& curve, const Eigen::Vector3d& p);
/// The same for many, which come in the curve's order, one after the other; any order will do.
std::vector<Eigen::Vector3d> nearest_points(const std::vector<Eigen::Vector3d>& curve,
                                            const std::vector<Eigen::Vector3d>& many);

/// Radius of the circle that fits the curve best (least squares in its plane); infinite for a straight one.
double radius_of_curvature(const std::vector<Eigen::Vector3d>& curve);

}  // namespace ostium
