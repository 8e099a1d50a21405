#pragma once
/// Stick and slip: what the hand feels beside friction in motion, where nobody knows when the wire slips.
///
/// Friction at rest is a share `static_more` larger than in motion, F. A wire that is fed slowly stands while the hand
/// goes on, and what the hand feels more, b, builds up by the stiffness of hand and wire; at some static_more F it
/// slips to b = 0 (Rabinowicz 1958, Proc Phys Soc 71:668). Friction at rest is not the same at each place: where it
/// slips is normal about that, with a tenth of it as standard deviation, from slip to slip, so that no law foresees the
/// tenth slip. Given what was measured before, b of a sample has a distribution, found by a filter on a grid; its mean
/// and spread are what is foretold of the sample. The likelihood of a run is then averaged over all that its slips may
/// be.
#include <Eigen/Core>

namespace ostium::data::push_pull {

/// What is known of a run beside its teeth.
struct SlidingRun {
  Eigen::VectorXd measured_N;  ///< at the hand
  Eigen::VectorXd moving_N;    ///< what the law says without teeth
  Eigen::VectorXd friction_N;  ///< of it, what friction in motion makes; >= 0
  Eigen::VectorXd direction;   ///< 1 in, -1 out
  Eigen::VectorXd inserted_m;
  Eigen::VectorXd sigma_N;  ///< noise of each sample
};

struct SawTeeth {
  Eigen::VectorXd mean_N, spread_N;  ///< of b, with the sign of the motion; spread: standard deviation
};

/// How much more friction at rest is, and the stiffness of hand and wire; both > 0.
struct Sticking {
  double static_more = 0.3, stiffness_N_per_m = 20;
};

/// Of each sample, from those before.
SawTeeth saw_teeth(const SlidingRun& run, const Sticking& sticking);

/// Minus twice the log likelihood of what was measured, up to what only the noise adds.
double surprise(const SlidingRun& run, const SawTeeth& teeth);

/// The most likely of many, if all that is slow in the run is something else: where a fit begins, as likelihoods of
/// periods have many maxima.
Sticking likely_sticking(SlidingRun run);

}  // namespace ostium::data::push_pull
