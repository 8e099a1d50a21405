#include "data/fit/explanation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "data/fit/sentences.h"
#include "data/fit/study.h"

namespace ostium {

namespace {

/// "shaft_torsion[1]": with the instrument that it is to act on.
ActiveEffect parsed(const std::string& word, const MeasurementSet& set) {
  ActiveEffect active;
  const std::size_t bracket = word.find('[');
  active.effect = &find_effect(word.substr(0, bracket));
  if (bracket != std::string::npos) {
    std::size_t read = 0;
    int index = -1;
    try {
      index = std::stoi(word.substr(bracket + 1), &read);
    } catch (const std::exception&) {
    }
    if (index < 0 || index >= static_cast<int>(set.instruments.size()) || word.substr(bracket + 1 + read) != "]")
      throw LoadError(fmt::format("\"{}\" names no instrument; expected {}[0] to [{}]", word, active.effect->id,
                                  set.instruments.size() - 1));
    active.instrument = index;
  }
  if (const std::string why = active.effect->why_not(set, active.instrument); !why.empty())
    throw LoadError(fmt::format("{}: {} cannot show in this set: {}", set.file, word, why));
  for (const EffectParameter& p : active.effect->parameters) active.values.push_back(p.prior);
  return active;
}

/// A difference in BIC that is strong evidence (Kass, Raftery 1995, J Am Stat Assoc 90:773).
constexpr double strong_evidence = 6;

/// By BIC; first, of those that the best has no strong evidence against, the one with the fewest parameters.
void put_best_first(std::vector<FittedModel>& candidates) {
  // Not stable_sort: its buffer does not know of the alignment that Eigen asks for (g++ 12).
  std::sort(candidates.begin(), candidates.end(),
            [](const FittedModel& a, const FittedModel& b) { return a.bic < b.bic; });
  if (candidates.empty()) return;
  auto best = candidates.begin();
  for (auto c = best; c != candidates.end() && c->bic < candidates.front().bic + strong_evidence; ++c)
    if (c->parameters.size() < best->parameters.size()) best = c;
  std::rotate(candidates.begin(), best, best + 1);
}

/// An effect counts if it predicts what it has not seen better, and pays for its numbers.
bool wins(const FittedModel& candidate, const FittedModel& declared, const Noise& noise) {
  const bool held_out = candidate.rms_held_out_m && declared.rms_held_out_m &&
                        *candidate.rms_held_out_m < 0.95 * *declared.rms_held_out_m;
  if (!held_out || candidate.bic > declared.bic - strong_evidence) return false;
  return !noise.sigma_m || is_noise(candidate, noise);
}

}  // namespace

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::explained:
      return "explained";
    case Verdict::effect:
      return "effect";
    case Verdict::ambiguous:
      return "ambiguous";
    default:
      return "unexplained";
  }
}

bool is_noise(const FittedModel& model, const Noise& noise) {
  if (noise.sigma_m) {
    // Four standard deviations of chi2 per degree of freedom; an estimated noise is itself known to some per cent.
    const double allowed = 1 + 4 * std::sqrt(2 / model.degrees_of_freedom) + (noise.declared ? 0 : 0.15);
    if (*model.chi2_per_dof > allowed) return false;
  }
  if (model.correlation && model.correlation->standard_errors > 4) return false;
  return std::none_of(model.dependences.list.begin(), model.dependences.list.end(),
                      [](const Dependence& d) { return d.significant; });
}

Explanation explain(const MeasurementSet& set, const ExplainOptions& options) {
  require_static(set);
  std::vector<std::vector<ActiveEffect>> tries;
  for (const auto& words : options.tries) {
    tries.emplace_back();
    for (const std::string& word : words) tries.back().push_back(parsed(word, set));
  }
  const Workers workers(options.threads);
  Explanation out;

  Study declared(set, workers, {}, options.progress);
  out.declared = declared.run(set.imaging.noise_sigma_m);
  out.nominal_misfits = declared.misfits_at_start();
  out.rms_nominal_m = rms(set, out.nominal_misfits);
  std::deque<Study> studies;
  for (const auto& tried : tries) {
    studies.emplace_back(set, workers, tried, options.progress);
    out.candidates.push_back(studies.back().run(set.imaging.noise_sigma_m));
  }
  // An estimate of the noise gains from a model that leaves little else.
  const FittedModel* closest = &out.declared;
  for (const FittedModel& c : out.candidates)
    if (c.rms_m < closest->rms_m) closest = &c;
  out.noise = noise_of(set, closest->misfits);
  declared.judge(out.declared, out.noise);
  for (std::size_t i = 0; i < studies.size(); ++i) studies[i].judge(out.candidates[i], out.noise);
  put_best_first(out.candidates);

  // Without a known noise nobody can say that a model fits to it: then what predicts better wins.
  const bool fits = is_noise(out.declared, out.noise);
  if ((!fits || !out.noise.sigma_m) && !out.candidates.empty() && wins(out.candidates.front(), out.declared, out.noise))
    out.verdict = Verdict::effect;
  else
    out.verdict = fits ? Verdict::explained : Verdict::unexplained;
  out.sentences = sentences(set, out);
  return out;
}

}  // namespace ostium
