#pragma once
/// Fits what a set declares, and the effects that are to be tried, and says what is left.
#include "data/identification/estimation/fit.h"
#include "data/identification/estimation/noise.h"
#include "data/identification/estimation/residual_tests.h"

namespace ostium {

struct ExplainOptions {
  /// Candidates: each a list of effects to be switched on together, of ids such as "shaft_torsion" or
  /// "shaft_torsion[1]".
  std::vector<std::vector<std::string>> tries;
  int threads = 0;  ///< 0: one for each core
  std::function<void(const std::string&)> progress;
  /// Every effect that there is, and several together, instead: where the declared model does not fit.
  bool library = false;
};

struct FittedParameter {
  Parameter parameter;
  double value = 0, sigma = 0;
  double informed = 0;  ///< 1: found in the data, 0: the prior's
};

/// One model: what is declared, or that with effects.
struct FittedModel {
  std::string name;                  ///< "shaft_torsion + roll_loss[0]", or "what is declared"
  std::vector<std::string> effects;  ///< ids, each once
  std::vector<FittedParameter> parameters;
  Changes changes;
  MeasuredView view;
  double rms_m = 0;
  std::optional<double> rms_held_out_m;
  std::optional<double> push_rms_N, push_rms_held_out_N;  ///< where pushes were measured in a vessel
  std::optional<double> chi2_per_dof;                     ///< none if the noise is not known
  double degrees_of_freedom = 0;
  double bic = 0;
  bool converged = false;
  std::vector<Shape> shapes;             ///< one per experiment
  std::vector<Eigen::VectorXd> misfits;  ///< one per experiment
  std::vector<Eigen::VectorXd>
      held_out_misfits;                    ///< the same by the fits that have not seen them; empty if there are none
  std::vector<double> experiment_rms_m;    ///< one per experiment
  std::optional<Correlation> correlation;  ///< along the wire
  Dependences dependences;
  /// Experiments whose shape, walked to with the fitted values, is another than the one that was fitted.
  std::vector<std::string> other_branches;
};

/// What a field without a name does for the declared model's residual.
struct Trace {
  std::string frame;        ///< material, lab, image, time
  std::string what;         ///< in words
  double removed = 0;       ///< of the squares that are not noise, 0 to 1
  double log_evidence = 0;  ///< against the declared model
  double numbers_used = 0;  ///< as many of the field's numbers as the data decide
  double rms_m = 0;         ///< of what it leaves
  std::optional<Eigen::Vector2d> from_tip_m;
  std::optional<Eigen::Vector3d> at_m;
};

/// What to measure next, and what it would tell apart.
struct NextExperiment {
  std::string why;
  std::vector<Placement> set;
  double difference_m = 0;  ///< between what two explanations predict
};

enum class Verdict { explained, effect, ambiguous, unexplained };

struct Explanation {
  Verdict verdict = Verdict::unexplained;
  Noise noise;
  double rms_nominal_m = 0;  ///< before anything was fitted but the frame that leaves the tip offset out
  std::vector<Eigen::VectorXd> nominal_misfits;
  FittedModel declared;
  std::vector<FittedModel> candidates;  ///< best first
  std::vector<std::string> sentences;   ///< what was found, in words
  std::vector<Trace> traces;            ///< of the declared model's residual, best first; empty if it is noise
  Signature signature;
  std::optional<NextExperiment> next_experiment;
  /// Of an ambiguous verdict: so many of the candidates explain the set equally.
  std::size_t rivals = 0;
  const FittedModel& best() const { return verdict == Verdict::effect ? candidates.front() : declared; }
};

/// Throws LoadError for a set that cannot be explained (in a vessel), an unknown effect, or one that cannot show.
Explanation explain(const MeasurementSet& set, const ExplainOptions& options);

std::string to_string(Verdict verdict);

/// Whether what a model leaves is noise: chi2, correlation along the wire, dependence on what was varied.
bool is_noise(const FittedModel& model, const Noise& noise);

}  // namespace ostium
