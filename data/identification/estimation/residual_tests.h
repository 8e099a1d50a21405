#pragma once
/// What the misfits of a fit move with. Each experiment is summed up by its mean misfit in a few stretches of the
/// instrument; shares of the sum of squares are told by permutation tests with a fixed seed.
#include "data/identification/forward/misfit.h"

namespace ostium::data {

struct ResidualTest {
  std::string on;            ///< "roll", "insertion", ...; "common in the material frame", ...
  double share = 0;          ///< of the misfits' squares that goes with it, 0 to 1
  double p_value = 1;        ///< chance of as large a share if the misfits had nothing to do with it
  bool significant = false;  ///< after allowing for how many were tried
};

struct Signature {
  std::string frame = "none";                 ///< none, material, lab, image, time
  std::optional<Eigen::Vector2d> from_tip_m;  ///< the stretch of the instrument where it acts
  std::optional<Eigen::Vector3d> at_m;        ///< or where in space
};

struct ResidualTests {
  std::vector<ResidualTest> list;  ///< strongest first
  Signature signature;
};

/// `misfits` belong to the set's experiments, in the frame of the measurement; `view` is how the fit saw them.
ResidualTests residual_tests(const MeasurementSet& set, const std::vector<Eigen::VectorXd>& misfits,
                             const MeasuredView& view);

}  // namespace ostium::data
