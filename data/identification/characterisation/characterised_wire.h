#pragma once
/// The stiffness of one instrument along its length, from several measured sets together.
#include <optional>

#include "data/identification/characterisation/stiffness_estimate.h"

namespace ostium::data {

/// No fit sees the gain of a load cell, a weight or the size of a pixel, and a bench of a laboratory is calibrated to
/// about this.
inline constexpr double calibrated_to = 0.01;

/// A number that several sets were combined to: the mean of their logarithms, weighted by the inverse of their
/// variances, to each of which that of calibration is added. Where they differ
/// by more than their errors say, the error is widened by the root of chi-square per degree of freedom (Birge 1932,
/// Phys Rev 40:207).
struct Combined {
  double value = 0;
  double sigma = 0;               ///< standard error of the logarithm
  std::vector<std::size_t> sets;  ///< which of them say something of it; empty: it is as declared
  std::vector<double> off;        ///< of each of these, how many of its standard errors it is off
  bool disagree() const;          ///< chi-square has a chance of less than 1 %

  bool measured() const { return !sets.empty(); }
};

struct Stretch {
  double from_tip_m = 0, to_tip_m = 0;
  Combined EI_N_m2, GJ_N_m2;
};

struct CharacterisedWire {
  std::vector<Stretch> stretches;  ///< from the tip, without gaps
  Combined friction;               ///< sigma is that of its logarithm, too
};

/// What is declared of a stretch.
struct DeclaredStretch {
  double from_tip_m = 0, to_tip_m = 0, EI_N_m2 = 0, GJ_N_m2 = 0;
};

/// estimates[k], friction[k]: of set k. A stretch whose bending alone was measured keeps the declared ratio of GJ to
/// EI.
CharacterisedWire combined(const std::vector<DeclaredStretch>& declared,
                           const std::vector<std::vector<StiffnessEstimate>>& estimates,
                           const std::vector<std::optional<FrictionEstimate>>& friction);

}  // namespace ostium::data
