#pragma once
/// Traces a residual without a hypothesis: which field, smallest in its prior's measure, removes it, on what evidence,
/// and where that field sits.
#include <functional>

#include "data/identification/estimation/fitted_model.h"
#include "data/identification/estimation/workers.h"

namespace ostium::data {

/// What a field without a name does for the declared model's residual.
struct ResidualAttribution {
  std::string frame;        ///< material, lab, image, time
  std::string what;         ///< in words
  double removed = 0;       ///< of the squares that are not noise, 0 to 1
  double log_evidence = 0;  ///< against the declared model
  double numbers_used = 0;  ///< as many of the field's numbers as the data decide
  double rms_m = 0;         ///< of what it leaves
  std::optional<Eigen::Vector2d> from_tip_m;
  std::optional<Eigen::Vector3d> at_m;
};

/// What each field does for the residual of `near`, best first by evidence. The evidence is Laplace's, the widest of a
/// few priors apart by factors of four (MacKay 1992, Neural Comput 4:415).
std::vector<ResidualAttribution> attribute_residual(const MeasurementSet& set, const Workers& workers,
                                                    const FittedModel& near, const Noise& noise,
                                                    const std::function<void(const std::string&)>& progress);

/// The signature that the attributions make of a residual; "none" if none of them has strong evidence.
Signature signature_of(const std::vector<ResidualAttribution>& attributions);

}  // namespace ostium::data
