#pragma once
/// The findings about a set, and the verdict.
#include "data/identification/estimation/fitted_model.h"
#include "data/identification/selection/next_experiment.h"
#include "data/identification/selection/residual_attribution.h"

namespace ostium::data {

/// `mostly`: an effect is named and added, and more than noise is left. `cannot_be_judged`: the noise is unknown, so
/// nothing says whether what is left is more than that.
enum class Verdict { explained, effect, mostly, ambiguous, unexplained, cannot_be_judged };

std::string to_string(Verdict verdict);

struct Explanation {
  Verdict verdict = Verdict::unexplained;
  Noise noise;
  double rms_nominal_m = 0;  ///< before fitting anything except, ignoring the tip offset, the frame
  std::vector<Eigen::VectorXd> nominal_misfits;
  FittedModel declared;
  std::vector<FittedModel> candidates;    ///< best first
  std::vector<std::string> verdict_text;  ///< the findings, in words
  std::vector<ResidualAttribution>
      attributions;  ///< of the declared model's residual, best first; empty if it is noise
  Signature signature;
  std::optional<NextExperiment> next_experiment;
  /// For an ambiguous verdict: how many of the candidates explain the set equally well.
  std::size_t rivals = 0;
  bool ended_early = false;  ///< the search was ended; what is here holds, and more might have been found
  const FittedModel& best() const { return verdict == Verdict::effect ? candidates.front() : declared; }
};

}  // namespace ostium::data
