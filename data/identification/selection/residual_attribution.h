#pragma once
/// Traces a residual without a hypothesis: which field, smallest in its prior's measure, removes it, on what evidence,
/// and where that field sits.
#include "data/identification/estimation/model_fit.h"

namespace ostium {

/// What each field does for the residual of `near`, best first by evidence. The evidence is Laplace's, the widest of a
/// few priors apart by factors of four (MacKay 1992, Neural Comput 4:415).
std::vector<Trace> traces(const MeasurementSet& set, const Workers& workers, const FittedModel& near,
                          const Noise& noise, const std::function<void(const std::string&)>& progress);

/// The signature that the traces make of a residual; "none" if none of them has strong evidence.
Signature signature_of(const std::vector<Trace>& traces);

}  // namespace ostium
