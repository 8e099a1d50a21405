#include "data/identification/curves/curve_fit.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/math/dense.h"
#include "data/identification/minimisation/least_squares.h"

namespace ostium::data::curves {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double inner(const EffectParameter& p, double value) { return p.logarithmic ? std::log(value) : value; }
double outer(const EffectParameter& p, double x) { return p.logarithmic ? std::exp(x) : x; }

}  // namespace

std::vector<Curves> Model::standardised() const {
  std::vector<Curves> out = misfits;
  for (std::size_t r = 0; r < wider.size(); ++r)
    for (std::size_t c = 0; c < wider[r].size(); ++c) out[r][c] = out[r][c].cwiseQuotient(wider[r][c]);
  return out;
}

double Model::rms() const {
  double sum = 0, count = 0;
  const std::vector<Curves> all = standardised();
  for (std::size_t r = 0; r < all.size(); ++r)
    for (std::size_t c = 0; c < all[r].size(); ++c)
      if (chosen.empty() || chosen[r][c])
        sum += all[r][c].squaredNorm(), count += static_cast<double>(all[r][c].size());
  return count > 0 ? std::sqrt(sum / count) : 0;
}

/// A model's numbers: those that are free in what is declared, then those of each effect; what has no spread is held.
struct Fit::Problem {
  const Set& set;
  const std::function<void()>& before_each;
  std::vector<std::size_t> effects;
  std::vector<EffectParameter> list;
  std::vector<std::string> labels;

  VectorXd each(double (*of)(const EffectParameter&)) const {
    VectorXd out(static_cast<Eigen::Index>(list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) out[static_cast<Eigen::Index>(i)] = of(list[i]);
    return out;
  }
  VectorXd prior() const {
    return each([](const EffectParameter& p) { return inner(p, p.prior); });
  }
  VectorXd spread() const {
    return each([](const EffectParameter& p) { return p.spread; });
  }
  VectorXd least() const {
    return each([](const EffectParameter& p) { return inner(p, p.least); });
  }
  VectorXd most() const {
    return each([](const EffectParameter& p) { return inner(p, p.most); });
  }

  std::vector<double> free_at(const VectorXd& x) const {
    std::vector<double> out;
    for (std::size_t i = 0; i < set.free().size(); ++i) out.push_back(outer(list[i], x[static_cast<Eigen::Index>(i)]));
    return out;
  }
  std::vector<Switched> on_at(const VectorXd& x) const {
    std::vector<Switched> out;
    std::size_t at = set.free().size();
    for (const std::size_t e : effects) {
      out.push_back({e, {}});
      for (const EffectParameter& p : set.effects()[e].parameters)
        out.back().values.push_back(p.spread > 0 ? outer(p, x[static_cast<Eigen::Index>(at++)]) : p.prior);
    }
    return out;
  }
  /// A model there, with its misfits only.
  Model at(const VectorXd& x) const {
    if (before_each) before_each();
    Foretold told = set.foretell(free_at(x), on_at(x));
    Model out;
    out.x = x, out.misfits = std::move(told.curves), out.wider = std::move(told.open);
    for (std::size_t r = 0; r < out.misfits.size(); ++r)
      for (std::size_t c = 0; c < out.misfits[r].size(); ++c) {
        const Channel& channel = set.runs()[r].channels[c];
        VectorXd& off = out.misfits[r][c];
        off = (channel.measured - off).cwiseQuotient(channel.sigma);
        if (out.wider.empty()) continue;
        VectorXd& wider = out.wider[r][c];
        wider = (1 + wider.cwiseQuotient(channel.sigma).array().square()).sqrt();
      }
    return out;
  }
};

Fit::Fit(const Set& set, const Noise& noise, std::vector<std::vector<bool>> chosen, std::function<void()> before_each)
    : set_(set), noise_(noise), chosen_(std::move(chosen)), before_each_(std::move(before_each)) {
  if (chosen_.empty())
    for (const Run& run : set.runs()) chosen_.emplace_back(run.channels.size(), true);
}

Fit::Problem Fit::problem(const std::vector<std::size_t>& effects) const {
  Problem out{set_, before_each_, effects, set_.free(), {}};
  for (const EffectParameter& p : set_.free()) out.labels.push_back(p.name);
  for (std::size_t k = 0; k < effects.size(); ++k) {
    const EffectHead& head = set_.effects()[effects[k]];
    const auto again = std::count(effects.begin(), effects.begin() + static_cast<std::ptrdiff_t>(k), effects[k]);
    for (const EffectParameter& p : head.parameters) {
      if (!(p.spread > 0)) continue;
      out.list.push_back(p);
      out.labels.push_back(head.id + (again > 0 ? "(" + std::to_string(again + 1) + ")." : ".") + p.name);
    }
  }
  return out;
}

namespace {

/// The misfits of what is chosen as independent numbers of variance 1; then, where the law leaves something open, rows
/// whose squares are what the wider normal laws cost, 2 log(width).
VectorXd data_rows(const Model& model, const Noise& noise, const std::vector<std::vector<bool>>& chosen) {
  std::vector<VectorXd> parts;
  Eigen::Index rows = 0;
  const auto add = [&](VectorXd part) { rows += part.size(), parts.push_back(std::move(part)); };
  const std::vector<Curves> misfits = model.standardised();
  for (std::size_t r = 0; r < misfits.size(); ++r)
    for (std::size_t c = 0; c < misfits[r].size(); ++c)
      if (chosen[r][c]) add(whitened(misfits[r][c], noise.channels[c]));
  for (std::size_t r = 0; r < model.wider.size(); ++r)
    for (std::size_t c = 0; c < model.wider[r].size(); ++c)
      if (chosen[r][c]) add((2 * model.wider[r][c].array().log()).sqrt());
  VectorXd out(rows);
  Eigen::Index at = 0;
  for (const VectorXd& part : parts) out.segment(at, part.size()) = part, at += part.size();
  return out;
}

/// Rows of the data, then of the priors; false if the model has no curves there.
bool rows_at(const Model& model, const Noise& noise, const std::vector<std::vector<bool>>& chosen,
             const VectorXd& prior, VectorXd& out) {
  const VectorXd data = data_rows(model, noise, chosen);
  out.resize(data.size() + prior.size());
  out << data, prior;
  return out.allFinite();
}

constexpr double anywhere = 0.4;  // of a range: a spread as large says that nothing is known of where in it

/// The prior, and to either side of it for each new number in turn; all over its range if it may be anywhere.
std::vector<VectorXd> starts(const VectorXd& from, const VectorXd& spread, const VectorXd& least, const VectorXd& most,
                             Eigen::Index first) {
  std::vector<VectorXd> out = {from};
  for (Eigen::Index i = first; i < from.size(); ++i) {
    const double range = most[i] - least[i];
    for (double place = 0.1; place < 1 && spread[i] > anywhere * range; place += 0.2) {
      out.push_back(from);
      out.back()[i] = least[i] + place * range;
    }
    for (const double side : {1.5, -1.5}) {
      if (spread[i] > anywhere * range) break;
      VectorXd to = from;
      to[i] = std::clamp(from[i] + side * spread[i], least[i] + 0.05 * (most[i] - least[i]),
                         most[i] - 0.05 * (most[i] - least[i]));
      out.push_back(to);
    }
  }
  return out;
}

constexpr double difference = 1e-3;   // step of derivatives, in spreads
constexpr int look = 5, finish = 40;  // iterations of a first look at each start, and of the best one

}  // namespace

Model Fit::run(const std::vector<std::size_t>& effects, const Model* near) const {
  const Problem p = problem(effects);
  const VectorXd prior = p.prior(), spread = p.spread(), least = p.least(), most = p.most();
  const auto residuals = [&](const VectorXd& x, VectorXd& r) {
    return rows_at(p.at(x), noise_, chosen_, (x - prior).cwiseQuotient(spread), r);
  };
  LeastSquares descent;
  descent.least = least, descent.most = most;
  descent.evaluate = [&](const VectorXd& x, VectorXd& r, MatrixXd* J) {
    if (!residuals(x, r)) return false;
    if (!J) return true;
    J->resize(r.size(), x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      VectorXd to = x, r_to;
      to[i] += x[i] + difference * spread[i] > most[i] ? -difference * spread[i] : difference * spread[i];
      if (!residuals(to, r_to)) return false;
      J->col(i) = (r_to - r) / (to[i] - x[i]);
    }
    return true;
  };
  VectorXd from = prior;
  Eigen::Index known = 0;
  if (near) {
    known = std::min(near->x.size(), from.size());
    from.head(known) = near->x.head(known);
  }
  VectorXd r;
  if (!residuals(from, r)) {
    from = prior;
    if (!residuals(from, r))
      throw LoadError(set_.file + ": the model has no curves for what is declared; is a unit or a place wrong?");
  }
  descent.residuals = static_cast<int>(r.size());
  std::vector<LeastSquaresResult> found;
  descent.most_iterations = look, descent.tolerance = 1e-4;
  // A law begins as what is declared: its numbers are many, and the squares nearly quadratic in them.
  const bool law = std::any_of(effects.begin(), effects.end(), [&](std::size_t e) { return set_.effects()[e].law; });
  for (const VectorXd& start : starts(from, spread, least, most, near && !law ? known : from.size())) {
    descent.start = start;
    VectorXd at_start;
    if (residuals(start, at_start)) found.push_back(minimise(descent));
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
  descent.most_iterations = finish, descent.tolerance = 1e-7;
  descent.start = found.front().x;
  const LeastSquaresResult best = minimise(descent);
  Model out = p.at(best.x);
  out.converged = best.converged;
  judge(p, out);
  return out;
}

void Fit::judge(const Problem& p, Model& model) const {
  model.on = p.on_at(model.x), model.chosen = chosen_;
  model.squares = data_rows(model, noise_, chosen_).squaredNorm();
  const VectorXd spread = p.spread();
  model.numbers = static_cast<double>(model.x.size());
  if (std::any_of(p.effects.begin(), p.effects.end(), [&](std::size_t e) { return set_.effects()[e].law; }))
    model.numbers -= covariance(p, model).diagonal().cwiseQuotient(spread.cwiseAbs2()).sum();
  double independent = 0;
  model.measured = 0;
  const std::vector<Curves> misfits = model.standardised();
  for (std::size_t r = 0; r < model.misfits.size(); ++r)
    for (std::size_t c = 0; c < model.misfits[r].size(); ++c) {
      if (!chosen_[r][c]) continue;
      const auto samples = static_cast<double>(model.misfits[r][c].size());
      model.clipped_squares += clipped(misfits[r][c], noise_.channels[c]).squaredNorm();
      model.measured += samples, independent += worth(noise_.channels[c], samples);
    }
  const double priors = (model.x - p.prior()).cwiseQuotient(spread).squaredNorm();
  model.bic = model.squares + priors + model.numbers * std::log(std::max(independent, 2.0));
}

namespace {

std::vector<std::size_t> effects_in(const Model& model) {
  std::vector<std::size_t> out;
  for (const Switched& s : model.on) out.push_back(s.effect);
  return out;
}

}  // namespace

double Fit::ahead(const Model& near, std::size_t effect) const {
  std::vector<std::size_t> effects = effects_in(near);
  effects.push_back(effect);
  const Problem p = problem(effects);
  const VectorXd prior = p.prior(), spread = p.spread(), least = p.least(), most = p.most();
  double best = near.squares;
  VectorXd from = prior;
  from.head(near.x.size()) = near.x;
  for (const VectorXd& start : starts(from, spread, least, most, near.x.size())) {
    const VectorXd r = data_rows(p.at(start), noise_, chosen_);
    MatrixXd J(r.size() + start.size(), start.size());
    VectorXd rhs(J.rows());
    for (Eigen::Index i = 0; i < start.size(); ++i) {
      VectorXd to = start;
      to[i] += start[i] + difference * spread[i] > most[i] ? -difference * spread[i] : difference * spread[i];
      J.col(i).head(r.size()) = (data_rows(p.at(to), noise_, chosen_) - r) / (to[i] - start[i]);
    }
    J.bottomRows(start.size()) = spread.cwiseInverse().asDiagonal();
    rhs << r, (start - prior).cwiseQuotient(spread);
    if (!J.allFinite() || !rhs.allFinite()) continue;
    const VectorXd step = core::least_squares(J, -rhs);
    best = std::min(best, (rhs + J * step).squaredNorm());
  }
  return best;
}

/// As if the noise were what it is taken to be.
MatrixXd Fit::covariance(const Problem& p, const Model& model) const {
  const VectorXd spread = p.spread(), least = p.least(), most = p.most();
  MatrixXd J(data_rows(model, noise_, chosen_).size(), model.x.size());
  for (Eigen::Index i = 0; i < model.x.size(); ++i) {
    VectorXd up = model.x, down = model.x;
    up[i] = std::min(up[i] + difference * spread[i], most[i]),
    down[i] = std::max(down[i] - difference * spread[i], least[i]);
    J.col(i) = (data_rows(p.at(up), noise_, chosen_) - data_rows(p.at(down), noise_, chosen_)) / (up[i] - down[i]);
  }
  MatrixXd H = J.transpose() * J;
  H.diagonal() += spread.cwiseAbs2().cwiseInverse();
  return core::inverse_of_symmetric(H);
}

std::vector<Fitted> Fit::parameters(const Model& model) const {
  const Problem p = problem(effects_in(model));
  const VectorXd spread = p.spread();
  // More scatter than the noise has widens what is known.
  const MatrixXd known = covariance(p, model) * std::max(model.per_freedom(), 1.0);
  std::vector<Fitted> out;
  for (std::size_t i = 0; i < p.list.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    Fitted f{p.list[i], p.labels[i]};
    f.value = outer(f.parameter, model.x[k]);
    const double sigma = std::sqrt(std::max(known(k, k), 0.0));
    f.sigma = f.parameter.logarithmic ? f.value * sigma : sigma;
    f.informed = std::clamp(1 - known(k, k) / (spread[k] * spread[k]), 0.0, 1.0);
    out.push_back(f);
  }
  return out;
}

std::vector<LearnedLaw> Fit::laws(const Model& model) const {
  const Problem p = problem(effects_in(model));
  std::vector<LearnedLaw> out;
  for (std::size_t k = 0; k < model.on.size(); ++k) {
    const EffectHead& head = set_.effects()[model.on[k].effect];
    if (!head.law) continue;
    const MatrixXd known = covariance(p, model) * std::max(model.per_freedom(), 1.0);
    out.push_back(with_band([&](const VectorXd& x) { return head.law(p.on_at(x)[k].values, p.free_at(x)); }, model.x,
                            known, p.spread()));
  }
  return out;
}

void Fit::hold_out(Model& model) const {
  const std::vector<std::size_t> effects = effects_in(model);
  const std::size_t runs = set_.runs().size(), channels = set_.runs()[0].channels.size();
  const std::size_t units = set_.hold_out_channels ? channels : runs, folds = std::min<std::size_t>(4, units);
  if (units < 2) return;
  double sum = 0, count = 0;
  for (std::size_t fold = 0; fold < folds; ++fold) {
    std::vector<std::vector<bool>> fitted = chosen_, scored = chosen_;
    for (std::size_t r = 0; r < runs; ++r)
      for (std::size_t c = 0; c < channels; ++c) {
        const bool out = (set_.hold_out_channels ? c : r) * folds / units == fold;
        fitted[r][c] = chosen_[r][c] && !out, scored[r][c] = chosen_[r][c] && out;
      }
    const auto any = [](const auto& list) {
      return std::any_of(list.begin(), list.end(),
                         [](const auto& run) { return std::any_of(run.begin(), run.end(), [](bool b) { return b; }); });
    };
    if (!any(fitted) || !any(scored)) continue;
    const Model without = Fit(set_, noise_, fitted, before_each_).run(effects, &model);
    sum += data_rows(without, noise_, scored).squaredNorm();
    for (std::size_t r = 0; r < runs; ++r)
      for (std::size_t c = 0; c < channels; ++c)
        if (scored[r][c]) count += static_cast<double>(set_.runs()[r].samples());
  }
  if (count > 0) model.held_out = std::sqrt(sum / count);
}

}  // namespace ostium::data::curves
