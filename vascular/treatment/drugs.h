#pragma once
/// Drugs, given as doses, with their effects over time. Heparin, nitrate and adenosine act on what the arteries and the
/// clotting do here, and are built in; all others are files of the catalogue (data/drugs), each a list of effects:
///   effect -> most * a / (a + half),  a: what is left of the doses, by its half-life; onset as a time constant
/// All numbers except doses and ranges usual in practice are estimates.
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/fields.h"
#include "vascular/heart/circulation.h"

namespace ostium::vascular {

enum class DrugTarget {
  resistance,   ///< share added to the systemic resistance
  dilation,     ///< CirculationInputs::dilation
  contraction,  ///< share added to both ventricles' elastance
  rate,         ///< share added to the sinus rate
  vagus,        ///< share of vagal action that is blocked
  muscle,       ///< share of the muscle's lost conductance that opens again in `onset_s` (FlowState::no_reflow)
  heparin       ///< units of heparin that one unit of it takes away, within `onset_s`
};
inline constexpr int drug_targets = 7;
inline constexpr const char* drug_target_names[drug_targets] = {"resistance", "dilation", "contraction", "rate",
                                                                "vagus",      "muscle",   "heparin"};

struct DrugEffect {
  DrugTarget target = DrugTarget::resistance;
  double most = 0, half_dose = 1, onset_s = 30;
  double works_in = 1;  ///< share of people, whom the seed draws; in the others it does nothing
};

struct Drug {
  std::string name, title, unit;  ///< unit: "ug", "mg"
  double least = 0, most = 0;     ///< of one dose
  double half_life_s = 60;
  std::vector<DrugEffect> effects;
};

struct DrugModel {
  std::uint64_t seed = 0;
  double weight_kg = 75;
  double act_before_s = 130, act_per_U_kg = 2.6;  ///< 70 U/kg: 310 s [practice: 250 to 350 s]
  double heparin_half_life_s = 5400;
  double nitrate_half_ug = 100, nitrate_in_s = 20, nitrate_out_s = 200;  ///< dose for half the effect; onset, decay
  double nitrate_widens = 0.09;  ///< of the diameter of epicardial arteries; 6 frames more (Gibson 1996)
  double nitrate_lowers = 0.3;   ///< contribution to the arterioles' dilation, see CirculationInputs
  double spasm_yields_s = 12;    ///< under the full effect
  double adenosine_half_ug = 25, adenosine_in_s = 4, adenosine_out_s = 12;
  double adenosine_opens_in = 0.78;  ///< of people with no-reflow (TIMI 3 in 78 % of a trial's 201: PMC8843359)
  std::vector<Drug> others;          ///< of the catalogue
};

struct Doses {  ///< given in this step; negative counts as zero
  double heparin_U = 0, nitrate_ug = 0, adenosine_ug = 0;
  int drug = -1;    ///< of DrugModel::others; -1: none
  double dose = 0;  ///< of that, in its unit
};

struct DrugState {
  double heparin_U = 0, nitrate_ug = 0, adenosine_ug = 0;  ///< still in effect
  double nitrate = 0, adenosine = 0;                       ///< effects, [0, 1)
  std::vector<double> amount;                              ///< (#others) left of each
  std::vector<double> effect;                              ///< (#effects of all of them, in order)
};
constexpr auto fields(const DrugState*) {
  using S = DrugState;
  return std::tuple{core::field("heparin_U", &S::heparin_U),
                    core::field("nitrate_ug", &S::nitrate_ug),
                    core::field("adenosine_ug", &S::adenosine_ug),
                    core::field("nitrate", &S::nitrate),
                    core::field("adenosine", &S::adenosine),
                    core::field("amount", &S::amount),
                    core::field("effect", &S::effect)};
}
DrugState make_state(const DrugModel& model);

void step(const DrugModel& model, const Doses& doses, double dt_s, DrugState& state);
/// Sum of all drugs' effects on a target.
double effect_on(DrugTarget target, const DrugModel& model, const DrugState& state);
/// Sets what drugs do to heart and vessels.
void act(const DrugModel& model, const DrugState& state, CirculationInputs& body);
/// How much of the muscle's lost conductance opens in a time constant, by all drugs.
double opens_muscle(const DrugModel& model, const DrugState& state);
/// Activated clotting time, s.
double act_s(const DrugModel& model, const DrugState& state);

}  // namespace ostium::vascular
