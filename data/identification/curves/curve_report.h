#pragma once
/// Writes what was found out about a set of curves: explanation.json (schema ostium-explanation/1), a page with plots,
/// and the set amended by the findings.
#include <string>

#include "data/identification/curves/curve_explanation.h"

namespace ostium::data::curves {

std::string to_json(const CurveExplanation& x);

/// A self-contained page: plots inline, no scripts.
std::string to_html(const CurveExplanation& x);

/// `root` with the fitted numbers and the accepted effects written in.
std::string amended(const JsonValue& root, const CurveExplanation& x);

/// Predicted curves of a set with nothing fitted, beside what was measured (schema ostium-prediction/1).
std::string prediction_json(const Set& set);
std::string prediction_csv(const Set& set);

}  // namespace ostium::data::curves
