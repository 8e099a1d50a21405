#include "data/identification/selection/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "data/identification/effects/effect_list.h"
#include "data/identification/estimation/model_fit.h"
#include "data/identification/forward/setup.h"
#include "data/identification/selection/residual_attribution.h"
#include "data/identification/selection/search.h"
#include "data/identification/selection/verdict.h"
#include "data/identification/selection/verdict_text.h"

namespace ostium::data {

namespace {

/// "shaft_torsion[1]": an effect and the instrument it acts on. An effect of one view is tried in each of its forms,
/// as no fit can choose a view; others in one, with everything fitted.
std::vector<ActiveEffect> parsed(const std::string& word, const MeasurementSet& set) {
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
  std::vector<ActiveEffect> out;
  if (!active.effect->parameters.empty() && active.effect->parameters.front().name == "view")
    for (const EffectForm& form : active.effect->forms(set, active.instrument))
      out.push_back(data::active(*active.effect, set, active.instrument, form));
  if (!out.empty()) return out;
  for (const EffectParameter& p : active.effect->parameters) active.values.push_back(p.prior);
  return {active};
}

/// The candidates that `words` stand for, one for each choice of forms.
std::vector<std::vector<ActiveEffect>> candidates_of(const std::vector<std::string>& words, const MeasurementSet& set) {
  std::vector<std::vector<ActiveEffect>> out = {{}};
  for (const std::string& word : words) {
    std::vector<std::vector<ActiveEffect>> longer;
    for (const std::vector<ActiveEffect>& before : out)
      for (const ActiveEffect& form : parsed(word, set)) {
        longer.push_back(before);
        longer.back().push_back(form);
      }
    out = longer;
  }
  return out;
}

/// Sorts by BIC; first comes the model with the fewest parameters among those not ruled out by strong evidence.
void put_best_first(std::vector<FittedModel>& candidates) {
  // Not stable_sort: its buffer ignores the alignment that Eigen needs (g++ 12).
  std::sort(candidates.begin(), candidates.end(),
            [](const FittedModel& a, const FittedModel& b) { return a.bic < b.bic; });
  if (candidates.empty()) return;
  auto best = candidates.begin();
  for (auto c = best; c != candidates.end() && c->bic < candidates.front().bic + strong_evidence; ++c)
    if (c->parameters.size() < best->parameters.size()) best = c;
  std::rotate(candidates.begin(), best, best + 1);
}

Explanation explain_with_library(const MeasurementSet& set, const ExplainOptions& options) {
  const Workers workers(options.threads);
  Explanation out;
  out.unit = set.unit();
  ModelFit declared(set, workers, {}, options.progress);
  out.declared = declared.run(set.imaging.noise_sigma_m);
  out.nominal_misfits = declared.misfits_at_start();
  out.rms_nominal_m = rms(set, out.nominal_misfits);
  out.noise = noise_of(set, out.declared.misfits);
  declared.judge(out.declared, out.noise);
  const bool done = out.noise.sigma_m && is_noise(out.declared, out.noise) && !too_small(set, out.declared);
  if (!done) {
    EffectSearch search(set, workers, options.progress, options.stop);
    out.candidates = search.run(declared, out.declared, out.noise);
    out.ended_early = options.stop && options.stop();
    if (!out.ended_early)
      out.attributions = attribute_residual(set, workers, out.declared, out.noise, options.progress);
    out.signature = signature_of(out.attributions);
  }
  decide(set, workers, out);
  out.verdict_text = verdict_text(set, out);
  return out;
}

}  // namespace

Explanation explain(const MeasurementSet& set, const ExplainOptions& options) {
  require_known(set);
  if (options.library) return explain_with_library(set, options);
  std::vector<std::vector<ActiveEffect>> tries;
  for (const auto& words : options.tries)
    for (const auto& candidate : candidates_of(words, set)) tries.push_back(candidate);
  const Workers workers(options.threads);
  Explanation out;
  out.unit = set.unit();

  ModelFit declared(set, workers, {}, options.progress);
  out.declared = declared.run(set.imaging.noise_sigma_m);
  out.nominal_misfits = declared.misfits_at_start();
  out.rms_nominal_m = rms(set, out.nominal_misfits);
  std::deque<ModelFit> model_fits;
  for (const auto& tried : tries) {
    out.ended_early = options.stop && options.stop();
    if (out.ended_early) break;
    model_fits.emplace_back(set, workers, tried, options.progress);
    out.candidates.push_back(model_fits.back().run(set.imaging.noise_sigma_m));
  }
  // The model with the smallest residual gives the best noise estimate.
  const FittedModel* closest = &out.declared;
  for (const FittedModel& c : out.candidates)
    if (c.rms_m < closest->rms_m) closest = &c;
  out.noise = noise_of(set, closest->misfits);
  declared.judge(out.declared, out.noise);
  for (std::size_t i = 0; i < model_fits.size(); ++i) model_fits[i].judge(out.candidates[i], out.noise);
  put_best_first(out.candidates);

  // Without a known noise no model can be said to fit; then the one that predicts better wins.
  const bool fits = is_noise(out.declared, out.noise);
  if ((!fits || !out.noise.sigma_m) && !out.candidates.empty() && wins(out.candidates.front(), out.declared, out.noise))
    out.verdict = Verdict::effect;
  else
    out.verdict = without_an_effect(fits, out.noise.sigma_m.has_value());
  if (out.verdict == Verdict::cannot_be_judged) out.next_experiment = repeat_for_noise(set);
  out.signature = out.declared.residual_tests.signature;
  out.verdict_text = verdict_text(set, out);
  return out;
}

}  // namespace ostium::data
