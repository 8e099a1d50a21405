#pragma once
/// Balloons and stents in a step of the treatment (treatment.h), in the order of these functions. A stent may lie in
/// the vessels of several balloons as far as they are its own, and two balloons side by side where both are.
#include "vascular/treatment/treatment.h"

namespace ostium::vascular {

/// Balloon `k` of the body is that which the inputs say; what is crimped on it moves with it.
void change_balloon(const TreatmentModel& model, const PlacedBalloon& placed, int k, TreatmentState& state);
/// Whether an unopened stent blocks the balloon's position.
bool is_blocked(const TreatmentModel& model, const PlacedBalloon& placed, const BalloonState& state,
                const std::vector<StentState>& stents);
/// Balloon `k`, which is not blocked, against wall, stents and what lies beside it. `so_far`: what is blocked.
BalloonReport inflate(const TreatmentModel& model, const TreatmentInputs& inputs, const TreatmentReport& so_far, int k,
                      double dt_s, TreatmentState& state, const TreatedVessels& vessels, TreatmentScratch& scratch);
/// Stents in the wall and those on a balloon.
void step_stents(const TreatmentModel& model, const TreatmentInputs& inputs, const TreatmentReport& report, double dt_s,
                 TreatmentState& state);
/// Balloons push the carinas that they lie at, and plaque into mouths.
void move_forks(const TreatmentModel& model, const TreatmentInputs& inputs, const TreatmentReport& report,
                const FlowTree& tree, TreatmentState& state);
/// Sets what occupies the lumen besides blood: shafts and balloons.
void fill_lumen(const TreatmentModel& model, const TreatmentInputs& inputs, const TreatmentReport& report,
                const TreatmentState& state, const TreatedVessels& vessels);

}  // namespace ostium::vascular
