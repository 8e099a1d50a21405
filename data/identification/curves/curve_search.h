#pragma once
/// Searches effects and mistakes of the data for what removes a set's residual.
#include "data/identification/curves/curve_explanation.h"

namespace ostium::data::curves {

/// BIC differences that count as strong and as positive evidence (Kass, Raftery 1995, J Am Stat Assoc 90:773).
inline constexpr double strong = 6, positive = 2;

class Search {
 public:
  Search(std::shared_ptr<const Set> set, const JsonValue& root, const CurveOptions& options);

  /// The declared model and candidates, best first, all judged with one noise.
  void run(CurveExplanation& out);

 private:
  Candidate candidate(const std::vector<std::size_t>& effects, const Model* near, const Noise& noise) const;
  std::vector<std::size_t> promising(const Candidate& c, std::size_t most) const;
  void look(CurveExplanation& out);
  void grow(std::vector<Candidate>& list, const Candidate& declared);
  void prune(std::vector<Candidate>& list) const;
  /// Laws that are learned from the data, where no effect alone leaves only noise; with the best model where they leave
  /// more than noise.
  void add_laws(std::vector<Candidate>& list, const Candidate& declared) const;
  std::optional<Candidate> mended(const Fault& fault) const;
  bool add_faults_of_all(std::vector<Candidate>& list, const Candidate& declared);
  void add_faults(std::vector<Candidate>& list, const Candidate& declared) const;
  void judge(Candidate& c, const Candidate& declared, const Noise& noise) const;
  void say(const std::string& what) const;
  /// A fit that asks `stop` before each evaluation and, once `may_end_`, throws Ended.
  Fit fit(const Set& set, const Noise& noise, const std::optional<Fault>& fault = {}) const;

  std::shared_ptr<const Set> set_;
  const JsonValue& root_;
  const CurveOptions& options_;
  Noise noise_;
  Noise noise_known_;  ///< before effects grew
  bool may_end_ = false, ended_ = false;
};

}  // namespace ostium::data::curves
