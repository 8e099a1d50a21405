#pragma once
/// What a patient feels, and whether they are awake.
///
///   pain, 0 to 10   p' = (10 smooth(W - threshold) - p) / 20 s,   W: share of the left ventricle whose ST would shift
///   the brain       keeps oxygen for some seconds: r' = (min(1.2, (p_mean - 10 mmHg) / 50 mmHg) - 0.6) / 5 s in [0,
///   1];
///                   who has less than 0.3 of it is not awake, and is again from 0.6 on
///
/// So pain comes after relaxation, contraction and ST (Griffin 1987: ST after 19 +- 12 s; angina later), and a third
/// have none, as a third show no ST. Without a pulse consciousness is lost after 5 to 10 s [textbook], in our person as
/// the pressure has fallen; below a mean of 40 mmHg it goes slowly. Thresholds and constants are estimates.
#include <cstdint>

#include "vascular/heart/ecg.h"

namespace ostium::vascular {

struct AwarenessModel {
  double threshold = 0.06;  ///< of W; a person's: 0.02 to 0.2, or silent
  double pain_s = 20, store_s = 5;
};
/// A person's; seed 0 is the mean.
AwarenessModel awareness_of(std::uint64_t seed);

struct AwarenessState {
  double pain = 0;    ///< [0, 10]
  double oxygen = 1;  ///< [0, 1] of the brain
  bool awake = true;
};
constexpr auto fields(const AwarenessState*) {
  using S = AwarenessState;
  return std::tuple{core::field("pain", &S::pain), core::field("oxygen", &S::oxygen), core::field("awake", &S::awake)};
}

void step(const AwarenessModel& model, const IschaemiaState& ischaemia, double mean_Pa, double dt_s, AwarenessState& s);

}  // namespace ostium::vascular
