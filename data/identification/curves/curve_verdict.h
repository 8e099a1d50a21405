#pragma once
/// The verdict on a set of curves, and its words.
#include "data/identification/curves/curve_explanation.h"

namespace ostium::data::curves {

/// Sets verdict, rivals, warnings, words, and what to measure next, from the judged models.
void decide(CurveExplanation& x);

}  // namespace ostium::data::curves
