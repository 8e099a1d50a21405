#pragma once
/// What is found out about a set of curves: the declared model, models with effects or with mistakes of the data
/// mended, and the verdict.
#include <functional>

#include "data/identification/curves/curve_fault.h"
#include "data/identification/curves/curve_fit.h"
#include "data/identification/selection/explanation.h"

namespace ostium::data::curves {

/// A model, judged.
struct Candidate {
  std::string name;                  ///< "machine_compliance + zero_offset", or what is wrong with the data
  std::vector<std::string> effects;  ///< ids, without duplicates
  Model model;
  std::vector<Fitted> parameters;
  std::vector<LearnedLaw> laws;
  std::optional<Fault> fault;
  std::shared_ptr<const Set> set;  ///< that the model is of: mended, if there is a fault
  double paid = 0;                 ///< what choosing it among many costs in BIC
  double share_removed = 0;        ///< of what the declared model leaves beyond noise, in squares
  double slow_shapes = 0;          ///< standard deviations of slow shapes beyond noise (curve_noise.h)
  bool is_noise = false;           ///< nothing but noise is left
  bool at_an_edge = false;  ///< a number of an effect is at the end of its range: it stands in for something else

  double bic() const { return model.bic + paid; }
};

struct CurveExplanation {
  Verdict verdict = Verdict::unexplained;
  std::shared_ptr<const Set> set;
  Noise noise;
  Candidate declared;
  std::vector<Candidate> candidates;  ///< best first
  std::size_t rivals = 0;             ///< for an ambiguous verdict: how many explain it equally
  std::vector<std::string> text;      ///< the findings, in words
  std::vector<std::string> warnings;
  std::string next;  ///< what to measure next; empty: nothing is open
  bool ended_early = false;

  bool found() const { return verdict == Verdict::effect || verdict == Verdict::mostly; }
  const Candidate& best() const { return found() ? candidates.front() : declared; }
};

struct CurveOptions {
  std::vector<std::vector<std::string>> tries;  ///< only these, by ids; empty: all
  std::function<void(const std::string&)> progress;
  std::function<bool()> stop = {};
};

/// Throws LoadError for a file that is not a set of curves, or an effect that is unknown.
CurveExplanation explain_curves(const JsonValue& root, const CurveOptions& options);

}  // namespace ostium::data::curves
