#pragma once
/// The findings about a set, and the verdict.
#include <memory>

#include "data/identification/estimation/fitted_model.h"
#include "data/identification/selection/data_fault.h"
#include "data/identification/selection/next_experiment.h"
#include "data/identification/selection/residual_attribution.h"

namespace ostium::data {

/// Of every standard error that is printed: what it is of.
inline constexpr const char* sigma_is =
    "The standard error is that of scatter; what is wrong in all of a bench (load cell, weights, size of a pixel) is "
    "not in it.";

/// `mostly`: an effect removes most of what is beyond noise, and something is left (`remaining`). `cannot_be_judged`:
/// the noise is unknown, so nothing says whether what is left is more than that.
enum class Verdict { explained, effect, mostly, ambiguous, unexplained, cannot_be_judged };

std::string to_string(Verdict verdict);
/// Of a search that was ended.
inline constexpr const char* ended_early_words =
    "Ended before everything was tried: another effect may do better than these.";

/// What the best model leaves beyond noise.
struct Remaining {
  double share = 0;  ///< of what the declared model leaves beyond noise, in chi-square, 0 to 1
  Signature signature;
  std::string text;
};

struct Explanation {
  Verdict verdict = Verdict::unexplained;
  MisfitUnit unit;  ///< of misfits and their root mean squares
  Noise noise;
  std::optional<double> declared_sigma_m;  ///< what the set says of its noise
  double rms_nominal_m = 0;                ///< before fitting anything except, ignoring the tip offset, the frame
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
  /// Whether the first candidate's effects are added; otherwise the declared model is the best.
  bool adds_effects = false;
  std::vector<DataFault> faults;                 ///< mended or left out before anything was judged
  std::shared_ptr<const MeasurementSet> mended;  ///< what was judged, if that is not the set as it was read
  std::optional<Remaining> remaining;
  std::vector<std::string> warnings;  ///< what to doubt in whatever the verdict says

  const FittedModel& best() const { return adds_effects ? candidates.front() : declared; }
  const MeasurementSet& judged(const MeasurementSet& as_read) const { return mended ? *mended : as_read; }
  /// Ids of the faults and of the effects that are added.
  std::vector<std::string> effects() const;
};

}  // namespace ostium::data
