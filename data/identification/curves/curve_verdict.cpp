#include "data/identification/curves/curve_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/identification/curves/curve_search.h"
#include "data/identification/curves/set/set_reader.h"
#include "data/identification/residuals/noise_model.h"

namespace ostium::data::curves {

namespace {

constexpr double clearly = 0.95;      // of the held-out error
constexpr double most_of = 0.5;       // of the excess over noise: an effect that removes as much is named
constexpr double far_from_prior = 3;  // standard deviations

bool predicts_better(const Candidate& c, const Candidate& declared) {
  const auto of_data = [&](const Switched& s) { return c.set->effects()[s.effect].of_data; };
  if (std::any_of(c.model.on.begin(), c.model.on.end(), of_data)) return c.is_noise;
  if (!c.model.held_out || !declared.model.held_out) return true;  // one run: BIC alone
  return *c.model.held_out < clearly * *declared.model.held_out;
}

bool wins(const Candidate& c, const Candidate& declared) {
  if (c.fault && !c.is_noise) return false;  // to leave a run out or to mend it always helps a little
  return c.bic() < declared.bic() - strong && predicts_better(c, declared) && !c.at_an_edge;
}

/// What a candidate's one effect is often confused with.
bool often_confused(const Candidate& a, const Candidate& b) {
  const auto names = [](const Candidate& c, const Candidate& other) {
    return !c.fault && std::any_of(c.model.on.begin(), c.model.on.end(), [&](const Switched& s) {
      const std::string& id = c.set->effects()[s.effect].confused_with;
      return std::find(other.effects.begin(), other.effects.end(), id) != other.effects.end();
    });
  };
  return names(a, b) || names(b, a);
}

/// BIC without what priors add.
double by_data(const Candidate& c) {
  return c.model.squares + c.model.numbers * std::log(std::max(c.model.measured, 2.0)) + c.paid;
}

/// Before the best, one that explains the set as well with some of its effects and no others.
void prefer_fewer(std::vector<Candidate>& list, const Candidate& declared) {
  for (std::size_t k = 1; k < list.size(); ++k) {
    const Candidate &c = list[k], &best = list.front();
    if (c.fault || best.fault || c.model.on.size() >= best.model.on.size()) continue;
    if (!c.is_noise || !wins(c, declared) || c.bic() > best.bic() + positive) continue;
    const auto in_best = [&](const Switched& s) {
      return std::any_of(best.model.on.begin(), best.model.on.end(),
                         [&](const Switched& b) { return b.effect == s.effect; });
    };
    if (std::all_of(c.model.on.begin(), c.model.on.end(), in_best))
      std::rotate(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(k),
                  list.begin() + static_cast<std::ptrdiff_t>(k) + 1);
  }
}

/// The best, then those that explain the set as well by another cause.
std::size_t rivals_of(std::vector<Candidate>& list, const Candidate& declared) {
  std::size_t rivals = 1;
  const Candidate best = list.front();
  for (std::size_t k = 1; k < list.size(); ++k) {
    const Candidate& c = list[k];
    // The same effects, in whatever order they were found, are one explanation.
    const bool same = std::is_permutation(c.effects.begin(), c.effects.end(), best.effects.begin(), best.effects.end());
    if (same || !c.is_noise || !wins(c, declared)) continue;
    // More effects than it takes are no rival.
    if (c.model.on.size() > best.model.on.size() && !best.fault) continue;
    // Two that data often confuse are told apart by the data alone, not by what was expected before.
    const bool confused = often_confused(best, c);
    const double further = confused ? by_data(c) - by_data(best) : c.bic() - best.bic();
    if (further > (confused ? strong : positive)) continue;
    std::rotate(list.begin() + static_cast<std::ptrdiff_t>(rivals), list.begin() + static_cast<std::ptrdiff_t>(k),
                list.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    ++rivals;
  }
  return rivals;
}

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

std::string what_is_left(const Candidate& c) {
  return fmt::format("{:.3g} times the noise is left{}", c.model.rms(),
                     c.slow_shapes > 4 ? ", in shapes that last over a run" : "");
}

std::string in_words(const Candidate& c) {
  if (c.fault) return fmt::format("{} ({})", c.fault->what, c.fault->mend);
  std::string out;
  for (const Switched& s : c.model.on) out += (out.empty() ? "" : ", and ") + c.set->effects()[s.effect].what;
  return out;
}

/// Of the first candidate that has laws, whether it won or not.
void add_laws(CurveExplanation& x) {
  for (const Candidate& c : x.candidates) {
    for (const LearnedLaw& law : c.laws) x.text.push_back("Learned " + data::in_words(law));
    if (!c.laws.empty()) return;
  }
}

void add_noise(CurveExplanation& x) {
  if (!x.noise.declared)
    x.text.push_back(
        "The noise is not declared for all that was measured; it is what neighbouring samples do not share.");
  if (x.noise.as_declared) return;
  for (std::size_t c = 0; c < x.noise.channels.size(); ++c) {
    const ChannelNoise& n = x.noise.channels[c];
    std::string how;
    if (n.size != 1) how += fmt::format(" {:.2g} times as large", n.size);
    if (n.correlation != 0)
      how += fmt::format("{} shared by neighbours (correlation {:.2f})", how.empty() ? "" : ",", n.correlation);
    if (n.heavy) how += fmt::format("{} with more far-off samples than a normal law", how.empty() ? "" : ",");
    if (!how.empty())
      x.text.push_back(
          fmt::format("The noise of the {} is not as declared: {}.", x.set->runs()[0].channels[c].label, how));
  }
}

void add_warnings(CurveExplanation& x) {
  for (std::string& copy : copies_in_words(measured_numbers(x.set->runs()))) x.warnings.push_back(std::move(copy));
  if (x.set->free().empty())
    x.warnings.emplace_back(
        "No stiffness makes a difference to what was measured: nothing comes where it is bent or turned; is a unit or "
        "a "
        "place wrong?");
  for (std::size_t i = 0; i < x.set->free().size() && i < x.best().parameters.size(); ++i) {
    const Fitted& f = x.best().parameters[i];
    const double off = f.parameter.logarithmic ? std::log(f.value / f.parameter.prior) : f.value - f.parameter.prior;
    if (std::fabs(off) > far_from_prior * f.parameter.spread)
      x.warnings.push_back(
          fmt::format("{} is {:.3g}, far from the {:.3g} that was declared; is a unit or a place wrong?",
                      f.parameter.what, f.value, f.parameter.prior));
  }
  if (const std::string doubt = doubt_of_noise(x.best().model.per_freedom(), x.best().model.degrees_of_freedom());
      !doubt.empty())
    x.warnings.push_back(doubt);
  for (const std::string& warning : x.warnings) x.text.push_back(warning);
}

bool too_small(const CurveExplanation& x) { return x.declared.model.measured < 2 * x.declared.model.numbers + 4; }

void sentence(CurveExplanation& x) {
  const Candidate& d = x.declared;
  switch (x.verdict) {
    case Verdict::explained:
      x.text.push_back("What is declared is enough; the rest is noise.");
      break;
    case Verdict::effect:
      x.text.push_back(
          fmt::format("With {}, nothing but noise is left: it removes {} of what was beyond the noise ({:.3g} times "
                      "the noise before, {:.3g} after).",
                      in_words(x.candidates[0]), percent(x.candidates[0].share_removed), d.model.rms(),
                      x.candidates[0].model.rms()));
      break;
    case Verdict::mostly:
      x.text.push_back(fmt::format("{} removes {} of what was beyond the noise, and is added; {}.",
                                   in_words(x.candidates[0]), percent(x.candidates[0].share_removed),
                                   what_is_left(x.candidates[0])));
      break;
    case Verdict::ambiguous: {
      std::string list;
      for (std::size_t k = 0; k < x.rivals; ++k) list += (k > 0 ? "; or " : "") + in_words(x.candidates[k]);
      x.text.push_back("Several explain it equally: " + list + ".");
      x.next =
          fmt::format("runs in which {} and {} differ: another span, path, length, speed or load than any measured",
                      x.candidates[0].name, x.candidates[1].name);
      break;
    }
    case Verdict::cannot_be_judged:
      if (too_small(x)) {
        x.text.push_back("There are too few samples to decide anything.");
        x.next = "more samples, and runs at other settings";
      } else {
        x.text.push_back("What was measured would be the same with any instrument, so it says nothing of this one.");
        x.next = "runs in which it is bent, turned or pushed where that can be seen";
      }
      break;
    case Verdict::unexplained:
      x.text.push_back(fmt::format("Neither what is declared nor what was tried explains it: {}.", what_is_left(d)));
      if (!x.candidates.empty())
        x.text.push_back(fmt::format("What helps most is {}: it removes {}; {}.", in_words(x.candidates[0]),
                                     percent(x.candidates[0].share_removed), what_is_left(x.candidates[0])));
  }
}

}  // namespace

void decide(CurveExplanation& x) {
  std::vector<Candidate>& list = x.candidates;
  // First what wins and leaves only noise, then what wins, then the rest; each by BIC.
  std::sort(list.begin(), list.end(), [&](const Candidate& a, const Candidate& b) {
    const auto rank = [&](const Candidate& c) { return wins(c, x.declared) ? (c.is_noise ? 0 : 1) : 2; };
    return rank(a) != rank(b) ? rank(a) < rank(b) : a.bic() < b.bic();
  });
  const bool any = !list.empty() && wins(list.front(), x.declared);
  if (too_small(x)) {
    x.verdict = Verdict::cannot_be_judged;
  } else if (any && list.front().is_noise) {
    prefer_fewer(list, x.declared);
    x.rivals = rivals_of(list, x.declared);
    x.verdict = x.rivals > 1 ? Verdict::ambiguous : Verdict::effect;
  } else if (x.declared.is_noise) {
    x.verdict = x.set->free().empty() ? Verdict::cannot_be_judged : Verdict::explained;
  } else if (any && list.front().share_removed >= most_of) {
    x.verdict = Verdict::mostly;
  } else {
    x.verdict = Verdict::unexplained;
  }
  sentence(x);
  if (x.ended_early) x.text.emplace_back(ended_early_words);
  add_laws(x);
  add_noise(x);
  add_warnings(x);
}

}  // namespace ostium::data::curves
