#pragma once
/// The noise of curves: its size against what is declared, what neighbours share of it, and its tails.
///
/// Noise is told from a wrong model by what it does not do: it does not last over a run, and it does not come back in
/// the next one. What a first-order autoregression of at most an eighth of a run explains is noise; what is left of
/// slow shapes after that is not (`slow_shapes`).
#include <optional>

#include "data/identification/curves/set/curve.h"

namespace ostium::data::curves {

/// Of one channel.
struct ChannelNoise {
  double size = 1;         ///< standard deviation against that declared (or that estimated, if none is)
  double correlation = 0;  ///< of neighbouring samples
  bool heavy = false;      ///< more large misfits than a normal law has
};

struct Noise {
  std::vector<ChannelNoise> channels;
  bool declared = true;     ///< false: estimated from neighbouring samples
  bool as_declared = true;  ///< size, correlation and tails are those of independent normal noise as declared
};

/// Independent, normal, of the size that is declared; with `runs` that declare none, their sigma is filled in by what a
/// cubic through five neighbours leaves (Gasser, Sroka, Jennen-Steinmetz 1986, Biometrika 73:625).
Noise declared_noise(std::vector<Run>& runs);

/// The noise that a model's misfits (in units of the noise as declared) look like.
Noise noise_of(const std::vector<Run>& runs, const std::vector<Curves>& misfits, const Noise& declared);

/// How many independent numbers the samples of a channel are worth.
double worth(const ChannelNoise& noise, double samples);

/// Misfits of one channel of one run as independent numbers of variance 1: whitened, divided by their size, large ones
/// drawn in (Huber 1964, Ann Math Stat 35:73) if tails are heavy.
Eigen::VectorXd whitened(const Eigen::VectorXd& misfit, const ChannelNoise& noise);

/// The same, for judging what is left: large ones count no more than 2.5, so that a few blunders are not taken for a
/// wrong model.
Eigen::VectorXd clipped(const Eigen::VectorXd& misfit, const ChannelNoise& noise);

/// By how many standard deviations the slow shapes of the runs (mean, slope and bends, there and back) exceed what
/// independent noise has in them: a wrong model is slow.
double slow_shapes(const std::vector<Run>& runs, const std::vector<Curves>& misfits, const Noise& noise,
                   double fitted_numbers);

}  // namespace ostium::data::curves
