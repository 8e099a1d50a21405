#include "data/identification/selection/explanation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <set>

#include "data/identification/estimation/model_fit.h"
#include "data/identification/selection/next_experiment.h"
#include "data/identification/selection/residual_attribution.h"
#include "data/identification/selection/search.h"
#include "data/identification/selection/verdict_text.h"

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

/// So few numbers beyond what is fitted that nothing can be decided, or no experiment to hold out.
bool too_small(const MeasurementSet& set, const FittedModel& declared) {
  return set.experiments.size() < 3 || declared.degrees_of_freedom < 6;
}

bool same_effects(const FittedModel& a, const FittedModel& b) {
  return std::set<std::string>(a.effects.begin(), a.effects.end()) ==
         std::set<std::string>(b.effects.begin(), b.effects.end());
}

/// Whether `more` has all effects of `fewer`, and others.
bool adds_to(const FittedModel& fewer, const FittedModel& more) {
  const std::set<std::string> a(fewer.effects.begin(), fewer.effects.end()),
      b(more.effects.begin(), more.effects.end());
  return a.size() < b.size() && std::includes(b.begin(), b.end(), a.begin(), a.end());
}

/// Of those that the first has no evidence against, the one with the fewest effects, and numbers, comes first.
void put_simplest_first(std::vector<FittedModel>& by_bic) {
  auto best = by_bic.begin();
  const auto simpler = [](const FittedModel& a, const FittedModel& b) {
    return std::pair(a.effects.size(), a.parameters.size()) < std::pair(b.effects.size(), b.parameters.size());
  };
  for (auto c = by_bic.begin(); c != by_bic.end() && c->bic < by_bic.front().bic + positive_evidence; ++c)
    if (simpler(*c, *best)) best = c;
  if (best != by_bic.end()) std::rotate(by_bic.begin(), best, best + 1);
}

/// Where two lists of effects differ in one each.
bool differ_in_a_pair(const FittedModel& a, const FittedModel& b) {
  std::vector<std::string> only_a, only_b;
  for (const std::string& id : a.effects)
    if (std::find(b.effects.begin(), b.effects.end(), id) == b.effects.end()) only_a.push_back(id);
  for (const std::string& id : b.effects)
    if (std::find(a.effects.begin(), a.effects.end(), id) == a.effects.end()) only_b.push_back(id);
  return only_a.size() == 1 && only_b.size() == 1 && often_confused(only_a[0], only_b[0]);
}

/// Whether `rival` explains the set as well as `best`. Of what is often confused, one may have more numbers that a
/// poorer one needs not: then it is chi-square that counts.
bool rivals(const FittedModel& best, const FittedModel& rival, bool noise_known) {
  if (same_effects(best, rival) || adds_to(best, rival)) return false;
  if (differ_in_a_pair(best, rival)) {
    const double behind = rival.bic - best.bic;
    if (behind < strong_evidence) return true;
    const double more = static_cast<double>(rival.parameters.size()) - static_cast<double>(best.parameters.size());
    return noise_known && more > 0 &&
           rival.chi2_per_dof.value_or(1e9) * rival.degrees_of_freedom <
               best.chi2_per_dof.value_or(0) * best.degrees_of_freedom + strong_evidence;
  }
  return rival.effects.size() <= best.effects.size() && rival.bic < best.bic + positive_evidence;
}

/// From candidates by BIC: the verdict, and the rivals after the best.
void decide(const MeasurementSet& set, const Workers& workers, Explanation& out) {
  const bool fits = is_noise(out.declared, out.noise), known = out.noise.sigma_m.has_value();
  const bool small = too_small(set, out.declared);
  if (fits && known && !small) {
    out.verdict = Verdict::explained;
    return;
  }
  std::vector<FittedModel> winners, others;
  for (FittedModel& c : out.candidates)
    (small || wins(c, out.declared, out.noise) ? winners : others).push_back(std::move(c));
  std::sort(winners.begin(), winners.end(), [](const FittedModel& a, const FittedModel& b) { return a.bic < b.bic; });
  put_simplest_first(winners);
  out.candidates = std::move(winners);
  const std::size_t count = out.candidates.size();
  // Best, then what rivals it, then the rest.
  auto end_of_rivals = out.candidates.begin();
  if (count > 0)
    end_of_rivals = std::partition(out.candidates.begin() + 1, out.candidates.end(), [&](const FittedModel& c) {
      return rivals(out.candidates.front(), c, known) || (small && !same_effects(out.candidates.front(), c));
    });
  const auto tied = static_cast<std::size_t>(end_of_rivals - out.candidates.begin());
  for (FittedModel& c : others) out.candidates.push_back(std::move(c));
  if (small) {
    out.verdict = Verdict::ambiguous;
    out.rivals = tied;
  } else if (count == 0) {
    out.verdict = fits ? Verdict::explained : Verdict::unexplained;
  } else if (tied > 1) {
    out.verdict = Verdict::ambiguous;
    out.rivals = tied;
  } else {
    out.verdict = Verdict::effect;
  }
  if (out.verdict != Verdict::ambiguous) return;
  const FittedModel& second = out.candidates.size() > 1 ? out.candidates[1] : out.declared;
  if (!out.candidates.empty())
    out.next_experiment = next_experiment(set, workers, out.candidates[0], second, out.noise);
  if (!out.next_experiment) {
    NextExperiment next;
    next.why = small ? "too few numbers to decide: repeat this with other rolls and insertions, and with a known load "
                       "at the tip"
                     : "no roll or insertion parts what is left; hang a known weight at the tip, or measure the base "
                       "and the frame by themselves";
    next.set = set.experiments.back().set;
    out.next_experiment = next;
  }
}

Explanation explain_with_library(const MeasurementSet& set, const ExplainOptions& options) {
  const Workers workers(options.threads);
  Explanation out;
  Study declared(set, workers, {}, options.progress);
  out.declared = declared.run(set.imaging.noise_sigma_m);
  out.nominal_misfits = declared.misfits_at_start();
  out.rms_nominal_m = rms(set, out.nominal_misfits);
  out.noise = noise_of(set, out.declared.misfits);
  declared.judge(out.declared, out.noise);
  const bool done = out.noise.sigma_m && is_noise(out.declared, out.noise) && !too_small(set, out.declared);
  if (!done) {
    Search search(set, workers, options.progress);
    out.candidates = search.run(declared, out.declared, out.noise);
    out.traces = traces(set, workers, out.declared, out.noise, options.progress);
    out.signature = signature_of(out.traces);
  }
  decide(set, workers, out);
  out.sentences = sentences(set, out);
  return out;
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
  require_known(set);
  if (options.library) return explain_with_library(set, options);
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
  out.signature = out.declared.dependences.signature;
  out.sentences = sentences(set, out);
  return out;
}

}  // namespace ostium
