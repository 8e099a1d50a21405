#include "data/identification/selection/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "data/formats/csv_table.h"
#include "data/identification/effects/effect_list.h"
#include "data/identification/estimation/model_fit.h"
#include "data/identification/forward/setup.h"
#include "data/identification/measurement/measured_numbers.h"
#include "data/identification/selection/data_faults.h"
#include "data/identification/selection/residual_attribution.h"
#include "data/identification/selection/search.h"
#include "data/identification/selection/verdict.h"
#include "data/identification/selection/verdict_text.h"

namespace ostium::data {

namespace {

/// Of what was measured, whatever any model says.
std::vector<std::string> doubts_of_data(const MeasurementSet& set) {
  std::vector<std::string> out = copies_in_words(measured_numbers(set));
  if (std::string doubt = set.table.empty() ? "" : doubt_of_end(set.table); !doubt.empty())
    out.push_back(std::move(doubt));
  return out;
}

/// What every form of an effect holds, as the first holds it: all else is fitted.
EffectForm held_in_all_forms(const Effect& effect, const MeasurementSet& set, std::optional<int> instrument) {
  EffectForm out;
  if (!effect.forms) return out;
  const std::vector<EffectForm> forms = effect.forms(set, instrument);
  for (const auto& [name, value] : forms.front().held)
    if (std::all_of(forms.begin(), forms.end(), [&, key = &name](const EffectForm& f) {
          return std::any_of(f.held.begin(), f.held.end(), [&](const auto& h) { return h.first == *key; });
        }))
      out.held.emplace_back(name, value);
  return out;
}

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
  return {
      data::active(*active.effect, set, active.instrument, held_in_all_forms(*active.effect, set, active.instrument))};
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

/// The effects that the model has besides those that the set declares.
std::vector<ActiveEffect> tried_effects(const MeasurementSet& set, const FittedModel& model) {
  const auto& all = model.changes.effects;
  return {all.begin() + static_cast<std::ptrdiff_t>(set.effects.size()), all.end()};
}

bool ends(const ExplainOptions& options) { return options.stop && options.stop(); }

/// Of what is fitted in any case: `stop` is told that the work goes on.
Workers workers_to_the_end(const ExplainOptions& options) {
  return Workers(options.threads, [&options] { ends(options); });
}

/// Of what may be left: they throw Ended.
Workers workers_until_ended(const ExplainOptions& options) {
  return Workers(options.threads, [&options] {
    if (ends(options)) throw Ended();
  });
}

/// Searches the effects one by one: whether any explains all experiments alone.
void search_single_effects(const MeasurementSet& set, const ExplainOptions& options, const ModelFit& declared,
                           Explanation& out) {
  const Workers workers = workers_until_ended(options);
  EffectSearch search(set, workers, options.progress);
  out.candidates = search.run(declared, out.declared, out.noise, 1);
  out.ended_early = search.ended();
}

/// Searches the effects, laws where these leave something, and the fields that have no name.
void search_effects(const MeasurementSet& set, const ExplainOptions& options, const ModelFit& declared,
                    Explanation& out) {
  const Workers workers = workers_until_ended(options);
  EffectSearch search(set, workers, options.progress);
  out.candidates = search.run(declared, out.declared, out.noise);
  out.ended_early = search.ended();
  // In a vessel fields take hundreds of histories, and are not asked where an effect explains all.
  const bool explained =
      set.vessel && std::any_of(out.candidates.begin(), out.candidates.end(),
                                [&](const FittedModel& c) { return wins(c, out.declared, out.noise); });
  if (!out.ended_early && !explained) try {
      out.attributions = attribute_residual(set, workers, out.declared, {}, out.noise, options.progress);
    } catch (const Ended&) {
      out.ended_early = true;
    }
  out.signature = signature_of(out.attributions);
}

/// Where the declared model's residual goes with nothing that was varied, it may be noise of another kind than
/// declared. It is if no effect wins, and no field has evidence, against that noise. Otherwise nothing is said.
std::optional<Explanation> explained_by_noise(const MeasurementSet& set, const Workers& workers,
                                              const ExplainOptions& options, Explanation out) {
  if (has_pattern(out.declared) || too_small(set, out.declared)) return {};
  std::optional<NoiseModel> other = other_noise(set, out.declared.misfits);
  if (!other) return {};
  ModelFit declared(set, workers, {}, options.progress);
  out.noise = {other->sigma, false, "residual", other};
  declared.weigh_by(out.noise);
  out.declared = declared.run(other->sigma);
  declared.judge(out.declared, out.noise);
  search_effects(set, options, declared, out);
  if (out.ended_early || !out.noise.model) return {};
  decide(set, workers, out);
  const bool field =
      !out.attributions.empty() && out.attributions.front().log_evidence > convincing_log_evidence(out.attributions);
  if (out.verdict == Verdict::effect || (out.verdict == Verdict::explained && !field)) return out;
  return {};
}

/// Whether a law alone leaves only noise as it is declared: then no effect with another noise is believed.
bool a_law_leaves_noise(const MeasurementSet& set, const ExplainOptions& options, const Explanation& x) {
  if (!x.noise.sigma_m) return false;
  const Workers workers = workers_until_ended(options);
  for (const ActiveEffect& law : laws_to_try(set)) {
    ModelFit fit(set, workers, {law}, options.progress);
    FittedModel learned = fit.run(x.noise.sigma_m);
    fit.judge(learned, x.noise);
    if (wins(learned, x.declared, x.noise)) return true;
  }
  return false;
}

/// Describes what the best model leaves beyond noise.
void describe_remaining(const MeasurementSet& set, const ExplainOptions& options, Explanation& out) {
  if (out.verdict != Verdict::mostly && out.verdict != Verdict::unexplained) return;
  if (!out.noise.sigma_m) return;
  Remaining left;
  left.share = 1 - share_removed(misfit_of(out.declared), misfit_of(out.best())).value_or(1);
  left.signature = out.signature;
  std::vector<ResidualAttribution> fields = out.attributions;
  if (out.adds_effects && !out.ended_early) try {
      fields = attribute_residual(set, workers_until_ended(options), out.best(), tried_effects(set, out.best()),
                                  out.noise, options.progress);
      left.signature = signature_of(fields);
    } catch (const Ended&) {
      out.ended_early = true;
    }
  left.text = remaining_text(out, fields, left);
  out.remaining = left;
  if (!out.next_experiment) out.next_experiment = where_most_is_left(set, out.best());
}

/// A set without the faults that its lengths show. `looks_for_faults`: whether others are looked for.
Explanation explain_mended(const MeasurementSet& set, const ExplainOptions& options, bool looks_for_faults);

/// What is left of a set whose fault was found; the fault heads the findings.
Explanation without_fault(const Mended& mended, const ExplainOptions& options) {
  Explanation out = explain_mended(mended.set, options, false);
  if (!out.mended) out.mended = std::make_shared<const MeasurementSet>(mended.set);
  add_faults(mended.faults, out);
  return out;
}

Explanation explain_mended(const MeasurementSet& set, const ExplainOptions& options, bool looks_for_faults) {
  const Workers workers = workers_to_the_end(options);
  Explanation out;
  out.declared_sigma_m = set.imaging.noise_sigma_m;
  out.unit = set.unit();
  ModelFit declared(set, workers, {}, options.progress);
  out.declared = declared.run(set.imaging.noise_sigma_m);
  out.nominal_misfits = declared.misfits_at_start();
  out.rms_nominal_m = rms(set, out.nominal_misfits);
  out.noise = noise_of(set, out.declared.misfits);
  declared.judge(out.declared, out.noise);
  const bool done = out.noise.sigma_m && is_noise(out.declared, out.noise) && !too_small(set, out.declared);
  std::optional<Mended> fault;
  std::optional<Explanation> by_noise;
  try {
    const Workers until_ended = workers_until_ended(options);
    if (!done && looks_for_faults) fault = find_fault(set, until_ended, out.declared, out.noise, options.progress);
    if (!done && !fault) by_noise = explained_by_noise(set, until_ended, options, out);
    if (by_noise && by_noise->verdict == Verdict::effect && a_law_leaves_noise(set, options, out)) by_noise.reset();
  } catch (const Ended&) {
    if (by_noise) by_noise->ended_early = true;
  }
  if (fault && !fault->left_out) return without_fault(*fault, options);
  if (by_noise) {
    out = std::move(*by_noise);
  } else {
    // An effect that explains all experiments is believed before one of them is given up.
    if (!done) (fault ? search_single_effects : search_effects)(set, options, declared, out);
    decide(set, workers, out);
    if (fault && out.verdict != Verdict::effect && !out.ended_early) return without_fault(*fault, options);
    describe_remaining(set, options, out);
  }
  warn_of_scales(out.best(), out.warnings);
  out.verdict_text = verdict_text(set, out);
  return out;
}

Explanation explain_with_library(const MeasurementSet& set, const ExplainOptions& options) {
  std::vector<std::string> warnings = doubts_of_data(set);
  const std::optional<Mended> lengths = mend_lengths(set, warnings);
  Explanation out = explain_mended(lengths ? lengths->set : set, options, true);
  if (lengths && !out.mended) out.mended = std::make_shared<const MeasurementSet>(lengths->set);
  if (lengths) add_faults(lengths->faults, out);
  out.warnings.insert(out.warnings.begin(), warnings.begin(), warnings.end());
  out.verdict_text.insert(out.verdict_text.begin() + 1, warnings.begin(), warnings.end());
  return out;
}

}  // namespace

Explanation explain(const MeasurementSet& set, const ExplainOptions& options) {
  require_known(set);
  if (options.library) return explain_with_library(set, options);
  std::vector<std::vector<ActiveEffect>> tries;
  for (const auto& words : options.tries)
    for (const auto& candidate : candidates_of(words, set)) tries.push_back(candidate);
  const Workers workers = workers_to_the_end(options);
  Explanation out;
  out.declared_sigma_m = set.imaging.noise_sigma_m;
  out.unit = set.unit();

  ModelFit declared(set, workers, {}, options.progress);
  out.declared = declared.run(set.imaging.noise_sigma_m);
  out.nominal_misfits = declared.misfits_at_start();
  out.rms_nominal_m = rms(set, out.nominal_misfits);
  std::deque<ModelFit> model_fits;
  const Workers until_ended = workers_until_ended(options);
  for (const auto& tried : tries) try {
      model_fits.emplace_back(set, until_ended, tried, options.progress);
      out.candidates.push_back(model_fits.back().run(set.imaging.noise_sigma_m));
    } catch (const Ended&) {
      out.ended_early = true;
      model_fits.pop_back();
      break;
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
  const bool open = !fits || !out.noise.sigma_m;
  const FittedModel* first = open && !out.candidates.empty() ? &out.candidates.front() : nullptr;
  const bool won = first && wins(*first, out.declared, out.noise);
  const bool most = first && !won && !fits && out.noise.sigma_m && removes_most_of_it(out, *first);
  if (most && !out.ended_early) try {
      out.attributions = attribute_residual(set, until_ended, out.declared, {}, out.noise, options.progress);
    } catch (const Ended&) {
      out.ended_early = true;
    }
  if (won)
    out.verdict = Verdict::effect, out.adds_effects = true;
  else if (most && removes_most_of_it(out, *first))  // with more evidence than a field without a name
    out.verdict = Verdict::mostly, out.adds_effects = true;
  else
    out.verdict = without_an_effect(fits, out.noise.sigma_m.has_value());
  if (out.verdict == Verdict::cannot_be_judged) out.next_experiment = repeat_for_noise(set);
  out.signature = out.declared.residual_tests.signature;
  describe_remaining(set, options, out);
  out.warnings = doubts_of_data(set);
  if (const std::optional<Mended> lengths = mend_lengths(set, out.warnings))
    for (const DataFault& f : lengths->faults) out.warnings.push_back(f.what + ": " + f.mend + ".");
  warn_of_scales(out.best(), out.warnings);
  out.verdict_text = verdict_text(set, out);
  return out;
}

}  // namespace ostium::data
