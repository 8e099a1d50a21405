#include "data/identification/selection/verdict.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "data/identification/effects/effect_list.h"
#include "data/identification/selection/evidence.h"

namespace ostium::data {

namespace {

bool same_effects(const FittedModel& a, const FittedModel& b) {
  return std::set<std::string>(a.effects.begin(), a.effects.end()) ==
         std::set<std::string>(b.effects.begin(), b.effects.end());
}

/// Whether `more` contains all effects of `fewer`, and others.
bool adds_to(const FittedModel& fewer, const FittedModel& more) {
  const std::set<std::string> a(fewer.effects.begin(), fewer.effects.end()),
      b(more.effects.begin(), more.effects.end());
  return a.size() < b.size() && std::includes(b.begin(), b.end(), a.begin(), a.end());
}

/// Puts first the model with the fewest effects, then parameters, among those the best has no evidence against.
void put_simplest_first(std::vector<FittedModel>& by_bic) {
  auto best = by_bic.begin();
  const auto simpler = [](const FittedModel& a, const FittedModel& b) {
    return std::pair(a.effects.size(), a.parameters.size()) < std::pair(b.effects.size(), b.parameters.size());
  };
  for (auto c = by_bic.begin(); c != by_bic.end() && c->bic < by_bic.front().bic + positive_evidence; ++c)
    if (simpler(*c, *best)) best = c;
  if (best != by_bic.end()) std::rotate(by_bic.begin(), best, best + 1);
}

/// Whether the lists differ in one effect each, and these two are often confused.
bool differ_in_a_pair(const FittedModel& a, const FittedModel& b) {
  std::vector<std::string> only_a, only_b;
  for (const std::string& id : a.effects)
    if (std::find(b.effects.begin(), b.effects.end(), id) == b.effects.end()) only_a.push_back(id);
  for (const std::string& id : b.effects)
    if (std::find(a.effects.begin(), a.effects.end(), id) == a.effects.end()) only_b.push_back(id);
  return only_a.size() == 1 && only_b.size() == 1 && often_confused(only_a[0], only_b[0]);
}

/// Whether `rival` explains the set as well as `best`. If the two differ in an often confused effect and the rival has
/// more parameters, chi-square decides instead of BIC.
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

/// A law has the freedom to look like any form of the library: it needs strong evidence over the best of them.
void give_way_to_the_library(std::vector<FittedModel>& winners, std::vector<FittedModel>& others) {
  double library = std::numeric_limits<double>::infinity();
  for (const FittedModel& c : winners)
    if (!has_law(c)) library = std::min(library, c.bic);
  for (auto c = winners.begin(); c != winners.end();) {
    if (has_law(*c) && c->bic > library - strong_evidence)
      others.push_back(std::move(*c)), c = winners.erase(c);
    else
      ++c;
  }
}

}  // namespace

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::explained:
      return "explained";
    case Verdict::effect:
      return "effect";
    case Verdict::mostly:
      return "mostly";
    case Verdict::ambiguous:
      return "ambiguous";
    case Verdict::cannot_be_judged:
      return "cannot_be_judged";
    default:
      return "unexplained";
  }
}

std::vector<std::string> Explanation::effects() const {
  std::vector<std::string> out;
  for (const DataFault& f : faults) out.push_back(f.id);
  if (adds_effects) out.insert(out.end(), best().effects.begin(), best().effects.end());
  return out;
}

Verdict without_an_effect(bool fits, bool noise_known) {
  return !fits ? Verdict::unexplained : noise_known ? Verdict::explained : Verdict::cannot_be_judged;
}

NextExperiment repeat_for_noise(const MeasurementSet& set) {
  NextExperiment next;
  next.why = "this once more, as the scatter of repeats tells the noise; or declare it (imaging.noise_sigma_mm)";
  next.set = set.experiments.back().set;
  return next;
}

bool too_small(const MeasurementSet& set, const FittedModel& declared) {
  return set.experiments.size() < 2 || declared.degrees_of_freedom < 6;
}

NextExperiment where_most_is_left(const MeasurementSet& set, const FittedModel& model) {
  const auto& each = model.experiment_rms_m;
  const auto worst = std::max_element(each.begin(), each.end()) - each.begin();
  NextExperiment next;
  next.why = "this once more, where most is left (\"" + set.experiments[worst].id +
             "\"), and with other rolls, insertions and loads about it: what the rest moves with tells its kind";
  next.set = set.experiments[worst].set;
  return next;
}

bool removes_most_of_it(const Explanation& x, const FittedModel& c) {
  if (!predicts_better(c, x.declared) || c.bic > x.declared.bic - strong_evidence || at_an_edge(c)) return false;
  const double log_evidence = (x.declared.bic - c.bic) / 2;
  return removes_most(misfit_of(x.declared), misfit_of(c)) &&
         std::none_of(x.attributions.begin(), x.attributions.end(),
                      [&](const ResidualAttribution& field) { return field.log_evidence > log_evidence; });
}

namespace {

/// The candidate of the fewest effects that removes most of it; one with more only if these again remove most of what
/// that leaves.
std::optional<std::size_t> mostly(const Explanation& x) {
  std::vector<std::size_t> order(x.candidates.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto rank = [&](const FittedModel& c) {
      return std::pair(c.effects.size(), c.bic + (has_law(c) ? strong_evidence : 0));
    };
    return rank(x.candidates[a]) < rank(x.candidates[b]);
  });
  std::optional<std::size_t> best;
  for (const std::size_t i : order) {
    const FittedModel& c = x.candidates[i];
    if (!removes_most_of_it(x, c)) continue;
    if (!best)
      best = i;
    else if (const FittedModel& b = x.candidates[*best];
             adds_to(b, c) && c.bic < b.bic - strong_evidence && removes_most(misfit_of(b), misfit_of(c)))
      best = i;
  }
  return best;
}

}  // namespace

/// From candidates sorted by BIC: the verdict, and the rivals of the best.
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
  give_way_to_the_library(winners, others);
  std::sort(winners.begin(), winners.end(), [](const FittedModel& a, const FittedModel& b) { return a.bic < b.bic; });
  // Of the forms of the same effects, the best.
  std::vector<FittedModel> one_of_each;
  for (FittedModel& c : winners) {
    const bool again = std::any_of(one_of_each.begin(), one_of_each.end(),
                                   [&](const FittedModel& better) { return same_effects(better, c); });
    (again ? others : one_of_each).push_back(std::move(c));
  }
  put_simplest_first(one_of_each);
  out.candidates = std::move(one_of_each);
  const std::size_t count = out.candidates.size();
  // Order: the best, its rivals, the rest.
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
  } else if (const auto part = count == 0 && known && !fits ? mostly(out) : std::nullopt) {
    out.verdict = Verdict::mostly;
    out.adds_effects = true;
    std::rotate(out.candidates.begin(), out.candidates.begin() + static_cast<std::ptrdiff_t>(*part),
                out.candidates.begin() + static_cast<std::ptrdiff_t>(*part) + 1);
  } else if (count == 0) {
    out.verdict = without_an_effect(fits, known);
  } else if (tied > 1) {
    out.verdict = Verdict::ambiguous;
    out.rivals = tied;
  } else {
    out.verdict = Verdict::effect;
    out.adds_effects = true;
  }
  if (out.verdict == Verdict::cannot_be_judged) out.next_experiment = repeat_for_noise(set);
  if (out.verdict != Verdict::ambiguous || out.ended_early) return;
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

}  // namespace ostium::data
