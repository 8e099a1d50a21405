#pragma once
/// Attributes a residual without a hypothesis: which field, smallest under its prior, removes it, with what evidence,
/// and where that field acts.
#include <functional>

#include "data/identification/estimation/fitted_model.h"
#include "data/identification/parallel/workers.h"

namespace ostium::data {

/// What an unnamed field explains of the declared model's residual.
struct ResidualAttribution {
  std::string frame;        ///< material, lab, image, time
  std::string what;         ///< description
  double removed = 0;       ///< share of chi-square beyond noise, 0 to 1
  double log_evidence = 0;  ///< relative to the declared model
  double numbers_used = 0;  ///< effective number of the field's parameters determined by the data
  double rms_m = 0;         ///< remaining residual
  std::optional<Eigen::Vector2d> from_tip_m;
  std::optional<Eigen::Vector3d> at_m;
};

/// The attributions of the residual of `near`, a model with the effects `with`, to each field, best first by evidence.
/// The evidence is Laplace's, the largest over a few priors whose widths differ by factors of four (MacKay 1992, Neural
/// Comput 4:415).
std::vector<ResidualAttribution> attribute_residual(const MeasurementSet& set, const Workers& workers,
                                                    const FittedModel& near, const std::vector<ActiveEffect>& with,
                                                    const Noise& noise,
                                                    const std::function<void(const std::string&)>& progress);

/// Log evidence that a field needs to be more than chance, as the best of all that were looked at.
double convincing_log_evidence(const std::vector<ResidualAttribution>& attributions);

/// The signature implied by the attributions; "none" if none has strong evidence or removes a tenth of the residual.
Signature signature_of(const std::vector<ResidualAttribution>& attributions);

}  // namespace ostium::data
