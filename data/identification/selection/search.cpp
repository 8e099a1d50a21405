#include "data/identification/selection/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <set>
#include <stdexcept>

#include "data/identification/effects/effect_list.h"

namespace ostium::data {

namespace {

constexpr int starts_for_one = 24;    // screened starts per added effect
constexpr std::size_t bases = 3;      // models to which another effect is added
constexpr std::size_t finalists = 4;  // models scored on held-out data
constexpr std::size_t most_effects = 4;
constexpr std::size_t ahead = 6;   // most promising additions to a model that are fitted
constexpr double far_behind = 30;  // in BIC behind the best; not considered further

/// An effect may be added again only in another form, on another stretch say.
bool can_join(const std::vector<ActiveEffect>& base, const ActiveEffect& more) {
  const auto is_first = [&](const ActiveEffect& b) {
    return b.effect == more.effect && b.instrument == more.instrument;
  };
  if (more.form == another_form && std::none_of(base.begin(), base.end(), is_first)) return false;
  for (const ActiveEffect& b : base) {
    if (b.effect != more.effect) continue;
    if (b.instrument == more.instrument && more.effect->of_several_stretches && b.form != more.form) continue;
    if (b.instrument && more.instrument && b.instrument != more.instrument) continue;
    return false;
  }
  return true;
}

std::string key_of(const std::vector<ActiveEffect>& effects) {
  std::set<std::string> names;
  for (const ActiveEffect& e : effects) names.insert(e.name());
  std::string key;
  for (const std::string& n : names) key += n + "|";
  return key;
}

/// Tells how far a list of fits has come. Threads may share it.
class Countdown {
 public:
  Countdown(std::size_t of, const std::function<void(const std::string&)>& progress) : of_(of), progress_(progress) {}
  void one_done() {
    const std::lock_guard lock(telling_);
    ++done_;
  }
  /// "3 of 12, 40 s left for these: " and the words.
  void tell(const std::string& words) {
    if (!progress_) return;
    const std::lock_guard lock(telling_);
    std::string before;
    if (done_ < of_) before = fmt::format("{} of {}", done_ + 1, of_);
    if (done_ > 0 && done_ < of_) {
      const double each_s = std::chrono::duration<double>(Clock::now() - begin_).count() / static_cast<double>(done_);
      before += fmt::format(", {:.0f} s left for these", each_s * static_cast<double>(of_ - done_));
    }
    progress_(before.empty() ? words : before + ": " + words);
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::size_t of_, done_ = 0;
  std::function<void(const std::string&)> progress_;
  Clock::time_point begin_ = Clock::now();
  std::mutex telling_;
};

template <class List>
bool is_in(const List& list, const std::vector<ActiveEffect>& effects) {
  const std::string key = key_of(effects);
  return std::any_of(list.begin(), list.end(), [&](const auto& t) { return key_of(t.effects) == key; });
}

/// None: the fit estimates it.
std::optional<double> sigma_to_fit_by(const MeasurementSet& set, const Noise& noise) {
  return noise.model ? noise.sigma_m : set.imaging.noise_sigma_m;
}

}  // namespace

void EffectSearch::for_each(std::size_t count, const std::function<void(std::size_t)>& model) const {
  if (set_.vessel && ranks() == 1)
    Workers(workers_.threads()).map(count, [&](std::size_t k) { return model(k), std::vector<double>{}; });
  else
    for (std::size_t k = 0; k < count; ++k) model(k);
}

void EffectSearch::add(const std::vector<std::vector<ActiveEffect>>& models, const FittedModel& near,
                       const Noise& noise) {
  std::vector<Tried> fresh;
  const auto countdown = std::make_shared<Countdown>(models.size(), progress_);  // the fits keep it
  for (const std::vector<ActiveEffect>& effects : models) {
    if (is_in(tried_, effects) || is_in(fresh, effects)) continue;
    fits_.emplace_back(set_, workers_, effects, [countdown](const std::string& words) { countdown->tell(words); });
    fresh.push_back({{}, &fits_.back(), effects, false});
    fits_.back().weigh_by(noise);
  }
  const auto fit = [&](std::size_t k) {
    if (ended_) return;
    const std::vector<ActiveEffect>& effects = fresh[k].effects;
    // A law begins as what is declared: its numbers are many, and all about zero.
    const bool law = std::any_of(effects.begin(), effects.end(), [](const ActiveEffect& e) { return e.effect->law; });
    const int starts = law ? 0 : set_.instruments.size() > 1 ? starts_for_one / 3 : starts_for_one;
    try {
      fresh[k].model =
          fresh[k].study->run_near(near, sigma_to_fit_by(set_, noise), near.rms_m / std::sqrt(2.0), starts);
      fresh[k].fitted = true;
    } catch (const std::runtime_error&) {  // no shapes with this effect
    } catch (const Ended&) {
      ended_ = true;
    }
    countdown->one_done();
  };
  for_each(fresh.size(), fit);
  for (Tried& t : fresh) {
    if (!t.fitted) continue;
    t.study->judge(t.model, noise);
    tried_.push_back(std::move(t));
  }
}

double EffectSearch::cost_ahead_of(const std::vector<ActiveEffect>& effects, const FittedModel& near,
                                   const Noise& noise) {
  ModelFit study(set_, workers_, effects, {});
  study.weigh_by(noise);
  try {
    return study.cost_ahead_near(near, sigma_to_fit_by(set_, noise), near.rms_m / std::sqrt(2.0));
  } catch (const std::runtime_error&) {
    return std::numeric_limits<double>::infinity();
  } catch (const Ended&) {
    ended_ = true;
    return std::numeric_limits<double>::infinity();
  }
}

void EffectSearch::add_to(const Tried* base, const FittedModel& near, const Noise& noise) {
  const std::vector<ActiveEffect> before = base ? base->effects : std::vector<ActiveEffect>{};
  std::vector<std::pair<double, std::vector<ActiveEffect>>> joined;
  for (const ActiveEffect& more : everything_to_try(set_)) {
    if (std::any_of(set_.effects.begin(), set_.effects.end(),
                    [&](const DeclaredEffect& d) { return d.id == more.effect->id; }))
      continue;
    if (!can_join(before, more)) continue;
    std::vector<ActiveEffect> effects = before;
    effects.push_back(more);
    joined.emplace_back(0, effects);
  }
  // At rest all single effects are fitted; to a model with effects, and in a vessel, where a fit takes some forty
  // histories and a look ahead a few, only the most promising.
  if ((base || set_.vessel) && joined.size() > ahead && !ended_) {
    if (progress_) progress_(fmt::format("which of {} effects promise most", joined.size()));
    for_each(joined.size(), [&](std::size_t k) { joined[k].first = cost_ahead_of(joined[k].second, near, noise); });
    std::sort(joined.begin(), joined.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    joined.resize(ahead);
  }
  std::vector<std::vector<ActiveEffect>> models;
  for (auto& [cost, effects] : joined) models.push_back(std::move(effects));
  add(models, near, noise);
}

void EffectSearch::sort_by_bic() {
  std::sort(tried_.begin(), tried_.end(), [](const Tried& a, const Tried& b) { return a.model.bic < b.model.bic; });
}

bool EffectSearch::fits(const FittedModel& model, const Noise& noise) const {
  return noise.sigma_m && is_noise(model, noise) && !at_an_edge(model);
}

/// Folds of histories cost as much as all the fits together: none for what cannot win any more.
bool EffectSearch::is_worth_folds(const Tried& tried) const {
  return !set_.vessel || std::all_of(tried_.begin(), tried_.end(), [&](const Tried& other) {
    return tried.model.bic < other.model.bic + far_behind;
  });
}

void EffectSearch::complete(Tried& tried, const Noise& noise) {
  if (tried.complete || ended_ || !is_worth_folds(tried)) return;
  tried.complete = true;
  tried.study->weigh_by(noise);
  try {
    tried.study->complete(tried.model, sigma_to_fit_by(set_, noise));
  } catch (const Ended&) {
    ended_ = true;
  }
  tried.study->judge(tried.model, noise);
}

/// Re-estimates the noise from the model with the smallest residual.
void EffectSearch::judge_again(const ModelFit& declared, FittedModel& of_declared, Noise& noise) {
  if (tried_.empty()) return;
  if (noise.model) return adopt_noise(declared, of_declared, noise);
  if (noise.declared) return;
  const FittedModel* closest = &of_declared;
  for (const Tried& t : tried_)
    if (t.model.rms_m < closest->rms_m) closest = &t.model;
  noise = noise_of(set_, closest->misfits);
  judge_all(declared, of_declared, noise);
}

void EffectSearch::judge_all(const ModelFit& declared, FittedModel& of_declared, const Noise& noise) {
  declared.judge(of_declared, noise);
  for (Tried& t : tried_) t.study->judge(t.model, noise);
}

void EffectSearch::adopt_noise(const ModelFit& declared, FittedModel& of_declared, Noise& noise) {
  if (!has_traces(set_)) return;
  const FittedModel* best = &of_declared;
  double least = own_noise_bic(set_, of_declared);
  std::size_t effects = 0;
  for (const Tried& t : tried_) {
    const double bic = own_noise_bic(set_, t.model);
    // An effect more is believed only on strong evidence.
    const double more = static_cast<double>(t.effects.size()) - static_cast<double>(effects);
    if (bic < least - (more > 0 ? strong_evidence : 0)) best = &t.model, least = bic, effects = t.effects.size();
  }
  if (has_pattern(*best)) return;
  const std::optional<NoiseModel> other = other_noise(set_, best->misfits);
  const bool changes = other || noise.model;
  if (!changes) return;
  noise = other ? Noise{other->sigma, false, "residual", other} : noise_of(set_, best->misfits);
  for (Tried& t : tried_) t.complete = false;
  judge_all(declared, of_declared, noise);
}

/// Each law alone; or, with the effects of the best model without a law.
void EffectSearch::add_laws(const Tried* library, const FittedModel& near, const Noise& noise) {
  const std::vector<ActiveEffect> beside = library ? library->effects : std::vector<ActiveEffect>{};
  std::vector<std::vector<ActiveEffect>> models;
  for (const ActiveEffect& law : laws_to_try(set_)) {
    if (std::any_of(set_.effects.begin(), set_.effects.end(),
                    [&](const DeclaredEffect& d) { return d.id == law.effect->id; }))
      continue;
    models.push_back(beside);
    models.back().push_back(law);
  }
  const std::size_t before = tried_.size();
  add(models, near, noise);
  for (std::size_t i = before; i < tried_.size(); ++i) complete(tried_[i], noise);
}

/// Known noise: adds effects until only noise is left.
void EffectSearch::grow_to_noise(const ModelFit& declared, FittedModel& of_declared, Noise& noise, std::size_t most) {
  for (std::size_t count = 1; count < most; ++count) {
    sort_by_bic();
    // Rough fits may leave some residual: complete the best before adding to them.
    for (std::size_t i = 0, polished = 0; i < tried_.size() && polished < 3; ++i)
      if (tried_[i].effects.size() == count) complete(tried_[i], noise), ++polished;
    // Before another noise is thought of, which would swallow what a law explains.
    const bool single = std::any_of(tried_.begin(), tried_.end(), [&](const Tried& t) { return fits(t.model, noise); });
    if (count == 1 && !single && !is_noise(of_declared, noise)) add_laws(nullptr, of_declared, noise);
    // One effect and another noise, rather than a third effect.
    if (count == 2 && !noise.model) adopt_noise(declared, of_declared, noise);
    sort_by_bic();
    const double best = tried_.empty() ? 0 : tried_.front().model.bic;
    bool enough = false;
    for (const Tried& t : tried_)
      enough = enough || (fits(t.model, noise) && t.model.bic < best + far_behind && !has_law(t.model));
    // A law that leaves only noise, rather than a third effect.
    const bool law = std::any_of(tried_.begin(), tried_.end(),
                                 [&](const Tried& t) { return has_law(t.model) && fits(t.model, noise); });
    if (enough || (law && count > 1)) return;
    std::vector<std::size_t> chosen;
    std::set<std::string> ids;
    for (std::size_t i = 0; i < tried_.size() && chosen.size() < (count == 1 ? bases : 1); ++i)
      if (tried_[i].effects.size() == count && !has_law(tried_[i].model) &&
          tried_[i].model.bic < of_declared.bic - strong_evidence &&
          ids.insert(tried_[i].effects.back().effect->id).second)
        chosen.push_back(i);
    std::deque<Tried> from;
    for (std::size_t i : chosen) from.push_back(tried_[i]);
    for (const Tried& base : from) add_to(&base, base.model, noise);
  }
  sort_by_bic();
  if (is_noise(of_declared, noise) || most < 2) return;
  if (std::any_of(tried_.begin(), tried_.end(), [&](const Tried& t) { return fits(t.model, noise); })) return;
  for (std::size_t i = 0; i < tried_.size(); ++i) {
    if (has_law(tried_[i].model)) continue;
    const Tried library = tried_[i];
    add_laws(&library, library.model, noise);
    break;
  }
  sort_by_bic();
}

/// Unknown noise: adds effects as long as they improve the prediction of held-out data.
void EffectSearch::grow_by_held_out(const FittedModel& of_declared, const Noise& noise) {
  FittedModel current = of_declared;
  for (std::size_t count = 1; count <= most_effects; ++count) {
    sort_by_bic();
    std::vector<Tried*> of_count;
    for (Tried& t : tried_)
      if (t.effects.size() == count && of_count.size() < finalists && !at_an_edge(t.model)) of_count.push_back(&t);
    Tried* best = nullptr;
    for (Tried* t : of_count) {
      complete(*t, noise);
      const bool better = predicts_better(t->model, current) && t->model.bic < current.bic - strong_evidence;
      if (better && (!best || *t->model.rms_held_out_m < *best->model.rms_held_out_m)) best = t;
    }
    if (!best) break;
    current = best->model;
    if (count == most_effects) break;
    const Tried base = *best;
    add_to(&base, base.model, noise);
  }
}

/// An early choice may be unnecessary once later effects are added, or fit better in another form: for the best model,
/// tries leaving out each effect, and each effect's other forms.
void EffectSearch::prune(const Noise& noise) {
  sort_by_bic();
  if (tried_.empty() || tried_.front().effects.size() < 2) return;
  const Tried best = tried_.front();
  std::vector<std::vector<ActiveEffect>> models;
  for (std::size_t i = 0; i < best.effects.size(); ++i) {
    std::vector<ActiveEffect> others = best.effects;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    models.push_back(others);
    for (const ActiveEffect& form : everything_to_try(set_)) {
      if (form.effect != best.effects[i].effect || form.instrument != best.effects[i].instrument) continue;
      if (!can_join(others, form)) continue;
      models.push_back(others);
      models.back().push_back(form);
    }
  }
  add(models, best.model, noise);
}

std::vector<FittedModel> EffectSearch::run(const ModelFit& declared, FittedModel& of_declared, Noise& noise,
                                           std::size_t most_of_known_noise) {
  add_to(nullptr, of_declared, noise);
  judge_again(declared, of_declared, noise);
  if (noise.sigma_m)
    grow_to_noise(declared, of_declared, noise, most_of_known_noise);
  else
    grow_by_held_out(of_declared, noise);
  prune(noise);
  judge_again(declared, of_declared, noise);
  sort_by_bic();
  for (std::size_t i = 0; i < std::min(finalists, tried_.size()); ++i) complete(tried_[i], noise);
  sort_by_bic();

  // Finalists: models that fit, the best of each combination of effects; if there are none, the best by BIC.
  std::vector<Tried*> chosen;
  std::set<std::set<std::string>> seen;
  for (bool only_fitting : {true, false})
    for (Tried& t : tried_) {
      if (chosen.size() >= finalists || (only_fitting && !fits(t.model, noise))) continue;
      std::set<std::string> ids(t.model.effects.begin(), t.model.effects.end());
      if (!seen.insert(ids).second) continue;
      chosen.push_back(&t);
    }
  for (Tried& t : tried_)
    if (t.complete && std::find(chosen.begin(), chosen.end(), &t) == chosen.end()) chosen.push_back(&t);
  std::vector<FittedModel> out;
  for (Tried* t : chosen) {
    complete(*t, noise);
    t->study->judge(t->model, noise);
    out.push_back(t->model);
  }
  std::sort(out.begin(), out.end(), [](const FittedModel& a, const FittedModel& b) { return a.bic < b.bic; });
  return out;
}

}  // namespace ostium::data
