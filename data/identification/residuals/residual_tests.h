#pragma once
/// Tests which quantities the misfits of a fit depend on. Each experiment is summarised by its mean misfit in a few
/// stretches of the instrument; shares of the sum of squares are assessed by permutation tests with a fixed seed.
#include "data/identification/forward/misfit.h"

namespace ostium::data {

struct ResidualTest {
  std::string on;            ///< "roll", "insertion", ...; "common in the material frame", ...
  double share = 0;          ///< of the sum of squared misfits explained, 0 to 1
  double p_value = 1;        ///< chance of as large a share without any dependence
  bool significant = false;  ///< after correction for the number of tests
};

struct Signature {
  std::string frame = "none";                 ///< none, material, lab, image, time
  std::optional<Eigen::Vector2d> from_tip_m;  ///< the stretch of the instrument where it acts
  std::optional<Eigen::Vector3d> at_m;        ///< or the point in space
};

struct ResidualTests {
  std::vector<ResidualTest> list;  ///< strongest first
  Signature signature;
};

/// `misfits` belong to the set's experiments, in the measurement frame; `view` is that of the fit.
ResidualTests residual_tests(const MeasurementSet& set, const std::vector<Eigen::VectorXd>& misfits,
                             const MeasuredView& view);

}  // namespace ostium::data
