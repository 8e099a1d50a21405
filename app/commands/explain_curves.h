#pragma once
/// `ostium explain` and `ostium predict` for sets of curves.
#include "data/identification/curves/curve_explanation.h"

namespace ostium::app {

/// Writes explanation.json, explanation.html and amended/measurement.json into `folder`, and prints the findings.
void explain_curves(const data::JsonValue& root, const data::curves::CurveOptions& options, const std::string& folder,
                    bool json);

/// Writes prediction.json and prediction.csv into `folder`, and prints how far each run is off.
void predict_curves(const data::JsonValue& root, const std::string& folder, bool json);

}  // namespace ostium::app
