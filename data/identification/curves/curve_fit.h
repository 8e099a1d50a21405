#pragma once
/// Fits a model to the runs of a set: weighted least squares with priors and, where the noise has them, its correlation
/// and its tails.
#include <functional>
#include <optional>

#include "data/identification/curves/set/curve_kind.h"
#include "data/identification/curves/set/curve_noise.h"
#include "data/identification/estimation/learned_law.h"

namespace ostium::data::curves {

struct Fitted {
  EffectParameter parameter;
  std::string label;  ///< "EI_scale[0]", "machine_compliance.mm_per_N"
  double value = 0, sigma = 0;
  double informed = 0;  ///< 1: determined by the data, 0: by its prior
};

/// One model of a set: what is declared, or with effects switched on.
struct Model {
  std::vector<Switched> on;
  Eigen::VectorXd x;            ///< the optimiser's numbers; logarithms of logarithmic parameters
  std::vector<Curves> misfits;  ///< measured minus model, in units of the noise as declared
  /// By how much what the law leaves open widens the noise of each number, from 1 on; empty: not at all.
  std::vector<Curves> wider;
  /// Of the chosen misfits, whitened and robust, in units of the noise. Where the law leaves something open, minus
  /// twice the log likelihood against that of misfits of 0 with noise alone.
  double squares = 0;
  double clipped_squares = 0;             ///< of the same, large ones cut if tails are heavy
  double measured = 0;                    ///< how many numbers were fitted
  std::vector<std::vector<bool>> chosen;  ///< which channels of which runs they are; empty: all
  double numbers = 0;                     ///< with how many; of a law, those that the data determine
  double bic = 0;
  std::optional<double> held_out;  ///< root mean square misfit of runs that the fit has not seen, in units of the noise
  bool converged = false;

  double degrees_of_freedom() const { return std::max(measured - numbers, 1.0); }
  double per_freedom() const { return clipped_squares / degrees_of_freedom(); }
  double rms()
      const;  ///< of the misfits that were fitted, in units of the noise as declared and of what the law leaves open
  /// Misfits in units of the noise and of what the law leaves open.
  std::vector<Curves> standardised() const;
};

class Fit {
 public:
  /// `chosen`: which channels of which runs are fitted; empty: all. `before_each`: called before the law is asked; may
  /// throw.
  Fit(const Set& set, const Noise& noise, std::vector<std::vector<bool>> chosen = {},
      std::function<void()> before_each = {});

  /// From `near`'s values of what both have, and from several starts of what is new.
  Model run(const std::vector<std::size_t>& effects, const Model* near) const;
  /// What the squares of `near` with one more effect would be, by one linear step from each start: a preview.
  double ahead(const Model& near, std::size_t effect) const;
  /// What `run` found, with its standard errors.
  std::vector<Fitted> parameters(const Model& model) const;
  /// The laws among its effects, with their bands.
  std::vector<LearnedLaw> laws(const Model& model) const;
  /// Adds the held-out error: folds of runs, each scored by a fit that has not seen it.
  void hold_out(Model& model) const;

 private:
  struct Problem;
  Problem problem(const std::vector<std::size_t>& effects) const;
  void judge(const Problem& problem, Model& model) const;
  Eigen::MatrixXd covariance(const Problem& problem, const Model& model) const;

  const Set& set_;
  Noise noise_;
  std::vector<std::vector<bool>> chosen_;
  std::function<void()> before_each_;
};

}  // namespace ostium::data::curves
