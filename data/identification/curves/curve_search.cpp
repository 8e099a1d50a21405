#include "data/identification/curves/curve_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/identification/parallel/workers.h"

namespace ostium::data::curves {

namespace {

constexpr std::size_t most_effects = 3, grown = 2, joined = 4, looked_at = 5;
constexpr double left_of_slow = 4;  // standard deviations of slow shapes that noise may have

std::vector<std::size_t> effects_of(const Model& model) {
  std::vector<std::size_t> out;
  for (const Switched& s : model.on) out.push_back(s.effect);
  return out;
}

void sort_by_bic(std::vector<Candidate>& list) {
  std::sort(list.begin(), list.end(), [](const Candidate& a, const Candidate& b) { return a.bic() < b.bic(); });
}

bool at_the_edge(const std::vector<Fitted>& parameters, std::size_t from) {
  for (std::size_t i = from; i < parameters.size(); ++i) {
    const Fitted& f = parameters[i];
    const EffectParameter& p = f.parameter;
    const double width = p.most - p.least;
    const bool low = p.logarithmic ? f.value < p.least * 1.01 : f.value < p.least + 1e-3 * width;
    const bool high = p.logarithmic ? f.value > p.most * 0.99 : f.value > p.most - 1e-3 * width;
    if (high || (low && p.least != 0)) return true;
  }
  return false;
}

/// Effects by their ids, each of which may have several forms: every combination.
std::vector<std::vector<std::size_t>> combinations(const Set& set, const std::vector<std::string>& ids) {
  std::vector<std::vector<std::size_t>> out = {{}};
  for (const std::string& id : ids) {
    std::vector<std::vector<std::size_t>> longer;
    std::string known;
    for (std::size_t e = 0; e < set.effects().size(); ++e) {
      known += (e > 0 ? ", " : "") + set.effects()[e].id;
      if (set.effects()[e].id != id) continue;
      for (std::vector<std::size_t> one : out) one.push_back(e), longer.push_back(one);
    }
    if (longer.empty())
      throw LoadError(
          fmt::format("{}: \"{}\" is no effect that can show in this set; there are {}", set.file, id, known));
    out = longer;
  }
  return out;
}

/// Mean square of each run's misfit over its noise.
std::vector<double> mean_squares(const Model& model) {
  std::vector<double> out;
  for (const Curves& run : model.standardised()) {
    double squares = 0, count = 0;
    for (const Eigen::VectorXd& channel : run)
      squares += channel.squaredNorm(), count += static_cast<double>(channel.size());
    out.push_back(squares / std::max(count, 1.0));
  }
  return out;
}

/// Whether a run is much farther off than any other: only noisier it may well be, by the noise of a second instrument.
bool stands_out(const Model& model, std::size_t run) {
  constexpr double much = 2;
  const std::vector<double> off = mean_squares(model);
  for (std::size_t r = 0; r < off.size(); ++r)
    if (r != run && off[run] < much * much * off[r]) return false;
  return true;
}

/// Whether a run scatters far less than every other: a unit that makes its numbers vanish beside the noise agrees with
/// whatever predicts nothing there.
bool vanishes(const Model& model, std::size_t run) {
  constexpr double little = 0.2;
  const std::vector<double> off = mean_squares(model);
  for (std::size_t r = 0; r < off.size(); ++r)
    if (r != run && off[run] > little * little * off[r]) return false;
  return true;
}

/// Whether the noise leaves something of every channel: else it agrees with whatever predicts nothing there.
bool stands_above_noise(const Set& set) {
  constexpr double least = 5;  // times the noise
  for (std::size_t c = 0; c < set.runs().front().channels.size(); ++c) {
    double most = 0;
    for (const Run& run : set.runs()) {
      const Channel& channel = run.channels[c];
      if (channel.sigma.size() == 0) return true;  // the noise is what neighbours do not share, in the same unit
      most = std::max(most, channel.measured.cwiseAbs().cwiseQuotient(channel.sigma).maxCoeff());
    }
    if (most < least) return false;
  }
  return true;
}

}  // namespace

Search::Search(std::shared_ptr<const Set> set, const JsonValue& root, const CurveOptions& options)
    : set_(std::move(set)), root_(root), options_(options) {}

void Search::say(const std::string& what) const {
  if (options_.progress) options_.progress(what);
}

Fit Search::fit(const Set& set, const Noise& noise, const std::optional<Fault>& fault) const {
  return Fit(set, noise, fault ? fault->chosen : std::vector<std::vector<bool>>{}, [this] {
    if (options_.stop && options_.stop() && may_end_) throw Ended();
  });
}

Candidate Search::candidate(const std::vector<std::size_t>& effects, const Model* near, const Noise& noise) const {
  Candidate out;
  out.set = set_;
  for (const std::size_t e : effects) {
    const EffectHead& head = set_->effects()[e];
    out.name += (out.name.empty() ? "" : " + ") + head.name();
    if (std::find(out.effects.begin(), out.effects.end(), head.id) == out.effects.end()) out.effects.push_back(head.id);
  }
  if (effects.empty()) out.name = "what is declared";
  out.model = fit(*set_, noise).run(effects, near);
  return out;
}

void Search::judge(Candidate& c, const Candidate& declared, const Noise& noise) const {
  const Fit found = fit(*c.set, noise, c.fault);
  c.parameters = found.parameters(c.model);
  c.laws = found.laws(c.model);
  if (!ended_) found.hold_out(c.model);
  std::vector<Run> runs;
  std::vector<Curves> misfits;
  const std::vector<Curves> left = c.model.standardised();
  for (std::size_t r = 0; r < c.set->runs().size(); ++r)
    if (!c.fault || c.fault->chosen.empty() || c.fault->chosen[r][0])
      runs.push_back(c.set->runs()[r]), misfits.push_back(left[r]);
  c.slow_shapes = slow_shapes(runs, misfits, noise, c.model.numbers);
  const double allowed = 1 + 4 * std::sqrt(2 / c.model.degrees_of_freedom()) + (noise.declared ? 0 : 0.3);
  c.is_noise = c.slow_shapes < left_of_slow && c.model.per_freedom() < allowed;
  c.at_an_edge = at_the_edge(c.parameters, c.set->free().size());
  const double excess = declared.model.squares - declared.model.degrees_of_freedom();
  if (excess > 0) c.share_removed = std::clamp((declared.model.squares - c.model.squares) / excess, 0.0, 1.0);
}

/// The effects that may join a model, those first that promise most. Two forms of one effect are one effect.
std::vector<std::size_t> Search::promising(const Candidate& c, std::size_t most) const {
  std::vector<std::pair<double, std::size_t>> order;
  const Fit look_ahead = fit(*set_, noise_);
  for (std::size_t e = 0; e < set_->effects().size(); ++e) {
    const bool there = std::find(c.effects.begin(), c.effects.end(), set_->effects()[e].id) != c.effects.end();
    if (!there && !set_->effects()[e].law)
      order.emplace_back(most < set_->effects().size() ? look_ahead.ahead(c.model, e) : 0, e);
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  if (order.size() > most) order.resize(most);
  std::vector<std::size_t> out;
  for (const auto& [squares, e] : order) out.push_back(e);
  return out;
}

/// Adds to the best models, one effect at a time, until nothing but noise is left or nothing more helps.
void Search::grow(std::vector<Candidate>& list, const Candidate& declared) {
  for (std::size_t size = 1; size <= (declared.is_noise ? 1 : most_effects); ++size) {
    std::vector<Candidate> from;
    if (size == 1) from.push_back(declared);
    sort_by_bic(list);
    for (const Candidate& c : list)
      if (from.size() < grown && c.model.on.size() + 1 == size) from.push_back(c);
    const double before = list.empty() ? declared.bic() : std::min(list.front().bic(), declared.bic());
    for (const Candidate& c : from)
      for (const std::size_t e : promising(c, size == 1 ? set_->effects().size() : joined)) {
        std::vector<std::size_t> effects = effects_of(c.model);
        effects.push_back(e);
        list.push_back(candidate(effects, &c.model, noise_));
        say(list.back().name);
      }
    sort_by_bic(list);
    if (list.empty() || list.front().bic() > before - strong) break;
    noise_ = noise_of(set_->runs(), list.front().model.standardised(), noise_);
    Candidate best = list.front();
    judge(best, declared, noise_);
    if (best.is_noise) break;
  }
}

/// Takes out of the best model what it does not need.
void Search::prune(std::vector<Candidate>& list) const {
  sort_by_bic(list);
  for (bool again = true; again && !list.empty() && list.front().model.on.size() > 1;) {
    again = false;
    for (std::size_t k = 0; k < list.front().model.on.size(); ++k) {
      std::vector<std::size_t> effects = effects_of(list.front().model);
      effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(k));
      Candidate smaller = candidate(effects, nullptr, noise_);
      if (smaller.bic() > list.front().bic() + positive) continue;
      list.insert(list.begin(), std::move(smaller));
      again = true;
      break;
    }
  }
}

void Search::add_laws(std::vector<Candidate>& list, const Candidate& declared) const {
  std::vector<std::size_t> laws;
  for (std::size_t e = 0; e < set_->effects().size(); ++e)
    if (set_->effects()[e].law) laws.push_back(e);
  if (laws.empty()) return;
  sort_by_bic(list);
  std::vector<std::size_t> beside;
  if (!list.empty()) {
    Candidate best = list.front();
    judge(best, declared, noise_);
    if (best.is_noise && best.model.on.size() == 1 && !best.at_an_edge) return;
    beside = effects_of(best.model);
  }
  // Chosen with the freedom to look like any effect: strong evidence over the best of them is asked for.
  const auto learned = [&](const std::vector<std::size_t>& effects, const Model* near) {
    Candidate c = candidate(effects, near, noise_);
    c.paid = strong;
    say(c.name);
    judge(c, declared, noise_);
    list.push_back(c);
    return c.is_noise;
  };
  bool enough = false;
  for (const std::size_t law : laws) enough = learned({law}, &declared.model) || enough;
  for (const std::size_t law : laws) {
    if (enough || beside.empty()) break;
    std::vector<std::size_t> joined = beside;
    joined.push_back(law);
    learned(joined, nullptr);
  }
}

/// The set with a mistake of its data mended; none: nothing like it can be. Against the noise as it was before effects
/// grew: what they leave of wrong data is no noise.
std::optional<Candidate> Search::mended(const Fault& fault) const {
  Candidate c;
  c.name = fault.what, c.effects = {fault.id}, c.set = fault.set, c.fault = fault;
  try {
    // From what is declared: a fit to data that are wrong is no place to begin at.
    c.model = fit(*fault.set, noise_known_, fault).run({}, nullptr);
  } catch (const LoadError&) {
    return {};
  }
  // What was chosen among many is paid for: one of so many runs, and of so many mends.
  c.paid = fault.paid + 2 * std::log(static_cast<double>(set_->runs().size())) + 2 * std::log(20.0);
  return c;
}

/// Whether one leaves nothing but noise: then nothing further need be looked for, and what effects left beside it is no
/// noise.
bool Search::add_faults_of_all(std::vector<Candidate>& list, const Candidate& declared) {
  say("all runs in another unit, or of the other sign");
  bool enough = false;
  sort_by_bic(list);
  std::vector<Candidate> mends;
  for (const Fault& fault : mends_of_all(root_)) {
    if (!stands_above_noise(*fault.set)) continue;
    auto c = mended(fault);
    if (!c || c->bic() > declared.bic() - strong) continue;
    judge(*c, declared, noise_known_);
    enough |= c->is_noise && !c->at_an_edge;
    mends.push_back(std::move(*c));
  }
  if (enough) {
    noise_ = noise_known_;
    if (list.size() > looked_at) list.resize(looked_at);
    for (Candidate& c : list) c.model = fit(*set_, noise_).run(effects_of(c.model), &c.model);
  }
  list.insert(list.end(), mends.begin(), mends.end());
  return enough;
}

void Search::add_faults(std::vector<Candidate>& list, const Candidate& declared) const {
  const std::size_t runs = set_->runs().size();
  if (runs < 3) return;
  say("one run left out at a time");
  std::vector<std::pair<double, std::size_t>> without;
  std::vector<Candidate> outliers;
  for (const Fault& fault : left_out(set_)) {
    outliers.push_back(*mended(fault));
    without.emplace_back(outliers.back().model.per_freedom(), outliers.size() - 1);
  }
  std::sort(without.begin(), without.end());
  const std::size_t worst = without[0].second;
  // Mends are sought where leaving a run out helps, and among swaps of it, which leave two wrong.
  for (std::size_t k = 0; k < std::min<std::size_t>(2, runs); ++k)
    for (const Fault& fault : mends_of(root_, without[k].second)) {
      auto c = mended(fault);
      if (c && c->bic() < declared.bic() - strong && !vanishes(c->model, without[k].second))
        list.push_back(std::move(*c));
    }
  // A run that is left out counts as if each of its samples had a number of its own, up to a fiftieth.
  Candidate& outlier = outliers[worst];
  if (!stands_out(outlier.model, worst)) return;
  const double gone = declared.model.measured - outlier.model.measured;
  outlier.paid += gone + std::max(5.0, gone / 50) * std::log(declared.model.measured);
  if (outlier.bic() < declared.bic() - strong) list.push_back(std::move(outlier));
}

/// Effects, laws and faults, or what was asked for.
void Search::look(CurveExplanation& out) {
  std::vector<Candidate>& list = out.candidates;
  if (options_.tries.empty()) {
    grow(list, out.declared);
    prune(list);
    if (!out.declared.is_noise && !add_faults_of_all(list, out.declared)) {
      add_laws(list, out.declared);
      add_faults(list, out.declared);
    }
  }
  for (const std::vector<std::string>& ids : options_.tries)
    for (const std::vector<std::size_t>& effects : combinations(*set_, ids))
      list.push_back(candidate(effects, &out.declared.model, noise_));
}

void Search::run(CurveExplanation& out) {
  noise_ = set_->noise();
  out.declared = candidate({}, nullptr, noise_);
  say("what is declared");
  judge(out.declared, out.declared, noise_);
  out.noise = noise_;
  if (out.declared.is_noise && options_.tries.empty()) return;
  // Noise that is not as declared may be all there is: then effects are tried one at a time, against that noise.
  const Noise own = noise_of(set_->runs(), out.declared.model.standardised(), noise_);
  if (!own.as_declared) {
    Candidate again = out.declared;
    again.model = fit(*set_, own).run({}, &out.declared.model);
    judge(again, again, own);
    if (again.is_noise) noise_ = own, out.declared = again;
  }
  noise_known_ = noise_;
  may_end_ = true;
  try {
    look(out);
  } catch (const Ended&) {
    ended_ = true;
  }
  may_end_ = false;
  std::vector<Candidate>& list = out.candidates;
  sort_by_bic(list);
  // One noise for all: that which the best model leaves.
  const bool better = !list.empty() && list.front().bic() < out.declared.bic();
  const Candidate& best = better ? list.front() : out.declared;
  noise_ = best.fault ? noise_known_ : noise_of(set_->runs(), best.model.standardised(), noise_);
  out.noise = noise_;
  if (const std::size_t most = ended_ ? 1 : looked_at; list.size() > most) list.resize(most);
  const auto again = [&](Candidate& c) { c.model = fit(*c.set, noise_, c.fault).run(effects_of(c.model), &c.model); };
  again(out.declared);
  judge(out.declared, out.declared, noise_);
  for (Candidate& c : list) {
    if (!out.noise.as_declared || !out.noise.declared) again(c);
    judge(c, out.declared, noise_);
  }
  sort_by_bic(list);
  out.ended_early = ended_;
}

}  // namespace ostium::data::curves
