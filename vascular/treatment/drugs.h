#pragma once
/// Drugs, given as doses, with their effects over time. All numbers except doses and ranges usual in practice are
/// estimates.
#include "core/base/fields.h"

namespace ostium::vascular {

struct DrugModel {
  double weight_kg = 75;
  double act_before_s = 130, act_per_U_kg = 2.6;  ///< 70 U/kg: 310 s [practice: 250 to 350 s]
  double heparin_half_life_s = 5400;
  double nitrate_half_ug = 100, nitrate_in_s = 20, nitrate_out_s = 200;  ///< dose for half the effect; onset, decay
  double nitrate_widens = 0.09;  ///< of the diameter of epicardial arteries; 6 frames more (Gibson 1996)
  double nitrate_lowers = 0.3;   ///< contribution to the arterioles' dilation, see HeartInputs
  double spasm_yields_s = 12;    ///< under the full effect
  double adenosine_half_ug = 25, adenosine_in_s = 4, adenosine_out_s = 12;
};

struct Doses {  ///< given in this step; negative counts as zero
  double heparin_U = 0, nitrate_ug = 0, adenosine_ug = 0;
};

struct DrugState {
  double heparin_U = 0, nitrate_ug = 0, adenosine_ug = 0;  ///< still in effect
  double nitrate = 0, adenosine = 0;                       ///< effects, [0, 1)
};
constexpr auto fields(const DrugState*) {
  using S = DrugState;
  return std::tuple{core::field("heparin_U", &S::heparin_U), core::field("nitrate_ug", &S::nitrate_ug),
                    core::field("adenosine_ug", &S::adenosine_ug), core::field("nitrate", &S::nitrate),
                    core::field("adenosine", &S::adenosine)};
}

void step(const DrugModel& model, const Doses& doses, double dt_s, DrugState& state);
/// Activated clotting time, s.
double act_s(const DrugModel& model, const DrugState& state);

}  // namespace ostium::vascular
