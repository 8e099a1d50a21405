#include "data/identification/selection/data_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "core/base/units.h"
#include "data/identification/estimation/model_fit.h"
#include "data/identification/selection/evidence.h"

namespace ostium::data {

namespace {

using units::degree;

constexpr std::size_t fewest_experiments = 5;  // one of fewer is a quarter of all that is known
constexpr std::size_t suspects = 3;            // the worst fitted
constexpr double stands_out = 3;               // its misfit, predicted by the others, against the worst of these
constexpr double gram_force_N = 9.80665e-3;

struct Mend {
  std::string words;
  std::function<void(Experiment&)> apply;
};

void scale_points(Experiment& e, double factor) {
  for (Eigen::Vector3d& p : e.points_m) p *= factor;
  e.radius_m *= factor;
}

/// Other units in which one quantity of an experiment may have been written.
std::vector<Mend> mends_of(const Experiment& e) {
  std::vector<Mend> out;
  for (std::size_t i = 0; i < e.set.size(); ++i) {
    const std::string of = e.set.size() > 1 ? fmt::format("set[{}].", i) : "";
    out.push_back({of + "roll_deg is in radians: times 57.3", [i](Experiment& x) { x.set[i].roll_rad /= degree; }});
    out.push_back({of + "roll_deg is in turns: times 360", [i](Experiment& x) { x.set[i].roll_rad *= 360; }});
    out.push_back({of + "roll_deg has the other sign: times -1", [i](Experiment& x) { x.set[i].roll_rad *= -1; }});
    for (const auto& [name, factor] : {std::pair{"cm", 10.0}, std::pair{"inches", 25.4}, std::pair{"m", 1000.0}})
      out.push_back({fmt::format("{}inserted_length_mm is in {}: times {:g}", of, name, factor),
                     [i, f = factor](Experiment& x) { x.set[i].inserted_m *= f; }});
  }
  for (const auto& [name, factor] : {std::pair{"cm", 10.0}, std::pair{"inches", 25.4}, std::pair{"m", 1000.0}})
    out.push_back({fmt::format("what was measured is in {}: times {:g}", name, factor),
                   [f = factor](Experiment& x) { scale_points(x, f); }});
  if (!e.tip_force_N.isZero())
    for (const auto& [name, factor] :
         {std::pair{"gram-force", gram_force_N}, std::pair{"mN", 1e-3}, std::pair{"pound-force", 4.4482216}})
      out.push_back({fmt::format("tip_force_N is in {}: times {:.6g}", name, factor),
                     [f = factor](Experiment& x) { x.tip_force_N *= f; }});
  if (e.elapsed_s) out.push_back({"elapsed_s is in minutes: times 60", [](Experiment& x) { *x.elapsed_s *= 60; }});
  return out;
}

/// How far an experiment is from what a model predicts that was fitted to others; infinite without a shape.
double predicted_rms(const MeasurementSet& set, const Experiment& e, const FittedModel& model) {
  MeasurementSet alone = set;
  alone.experiments = {e};
  const Experiment& it = alone.experiments[0];
  for (std::size_t i = 0; i < it.set.size(); ++i)
    if (it.set[i].inserted_m > set.instruments[i].length_m) return std::numeric_limits<double>::infinity();
  try {
    const std::vector<StaticEquilibrium> anchors = walk(alone, model.changes);
    const PredictedShape shape = shape_from(setup_of(alone, it, model.changes), anchors[0]);
    if (!shape.converged) return std::numeric_limits<double>::infinity();
    return rms({&it}, {misfit(it, shape, seen(alone, it, model.changes, model.view))});
  } catch (const std::invalid_argument&) {  // these numbers do not describe a rod
    return std::numeric_limits<double>::infinity();
  }
}

class FaultFinder {
 public:
  FaultFinder(const MeasurementSet& set, const Workers& workers, const FittedModel& declared, const Noise& noise,
              const std::function<void(const std::string&)>& progress)
      : set_(set), workers_(workers), declared_(declared), noise_(noise), progress_(progress) {}

  std::optional<Mended> find() const {
    if (std::optional<Mended> views = exchanged_views()) return views;
    if (set_.experiments.size() < fewest_experiments) return {};
    std::optional<Mended> mended = exchanged();
    double least = mended ? chi2_of(mended->set) : std::numeric_limits<double>::infinity();
    std::optional<Mended> left_out;
    double least_left_out = std::numeric_limits<double>::infinity();
    for (const std::size_t k : worst()) {
      MeasurementSet rest = set_;
      rest.experiments.erase(rest.experiments.begin() + static_cast<std::ptrdiff_t>(k));
      const std::optional<FittedModel> others = fitted(rest);
      if (!others || !removes_most(misfit_of(declared_), misfit_of(*others))) continue;
      const double off = predicted_rms(set_, set_.experiments[k], *others);
      const double worst_of_them = *std::max_element(others->experiment_rms_m.begin(), others->experiment_rms_m.end());
      if (off < stands_out * worst_of_them) continue;
      if (auto m = with_a_unit(k, *others, off)) {
        const double chi2 = chi2_of(m->set);
        if (chi2 < least) mended = m, least = chi2;
      }
      const double chi2 = misfit_of(*others).chi2;
      if (chi2 < least_left_out) left_out = without(k, rest, off, worst_of_them), least_left_out = chi2;
    }
    return mended ? mended : left_out;
  }

 private:
  std::vector<std::size_t> worst() const {
    std::vector<std::size_t> order(set_.experiments.size());
    std::iota(order.begin(), order.end(), 0);
    const auto& off = declared_.experiment_rms_m;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return off[a] > off[b]; });
    order.resize(std::min(order.size(), suspects));
    return order;
  }

  /// The declared model of a set; none without shapes.
  std::optional<FittedModel> fitted(const MeasurementSet& set) const {
    try {
      ModelFit study(set, workers_, {}, progress_);
      FittedModel model = study.run_near(declared_, *noise_.sigma_m, 0, few_starts);
      study.judge(model, noise_);
      return model;
    } catch (const std::runtime_error&) {
      return {};
    }
  }

  double chi2_of(const MeasurementSet& set) const {
    const std::optional<FittedModel> model = fitted(set);
    return model && removes_most(misfit_of(declared_), misfit_of(*model)) ? misfit_of(*model).chi2
                                                                          : std::numeric_limits<double>::infinity();
  }

  /// Two of the worst with each other's measurement.
  std::optional<Mended> exchanged() const {
    const std::vector<std::size_t> list = worst();
    std::optional<Mended> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < list.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        Mended m{set_, {}, false};
        Experiment &x = m.set.experiments[list[a]], &y = m.set.experiments[list[b]];
        if (x.kind != y.kind) continue;
        std::swap(x.points_m, y.points_m), std::swap(x.radius_m, y.radius_m);
        const double chi2 = chi2_of(m.set);
        if (chi2 >= least) continue;
        least = chi2, best = m;
        best->faults = {{"swapped_experiments",
                         {std::min(x.id, y.id), std::max(x.id, y.id)},
                         "the measurements of " + x.id + " and " + y.id + " are exchanged",
                         "what was measured in the one belongs to the other",
                         "exchanged, they fit as the others do, with no number fitted"}};
      }
    return best;
  }

  /// Two views, each with the other's geometry: all experiments are off, and none stands out.
  std::optional<Mended> exchanged_views() const {
    if (set_.views.size() != 2) return {};
    Mended m{set_, {}, false};
    std::swap(m.set.views[0].camera, m.set.views[1].camera);
    if (std::isinf(chi2_of(m.set))) return {};
    std::vector<std::string> all;
    for (const Experiment& e : set_.experiments) all.push_back(e.id);
    m.faults = {{"swapped_views", all, "the views " + set_.views[0].id + " and " + set_.views[1].id + " are exchanged",
                 "each has the other's geometry", "so exchanged, nine tenths of what is beyond noise are gone"}};
    return m;
  }

  /// The unit in which the others predict it best.
  std::optional<Mended> with_a_unit(std::size_t k, const FittedModel& others, double off) const {
    std::optional<Mended> best;
    double least = off / stands_out;
    for (const Mend& mend : mends_of(set_.experiments[k])) {
      Mended m{set_, {}, false};
      Experiment& e = m.set.experiments[k];
      mend.apply(e);
      const double now = predicted_rms(set_, e, others);
      if (now >= least) continue;
      least = now, best = m;
      best->faults = {{"unit_error",
                       {e.id},
                       "a quantity of " + e.id + " is in another unit",
                       mend.words,
                       fmt::format("the others predict it {:.2g} {} off as it is written and {:.2g} {} off in that "
                                   "unit, with no number fitted",
                                   off / unit_.size, unit_.name, now / unit_.size, unit_.name)}};
    }
    return best;
  }

  Mended without(std::size_t k, const MeasurementSet& rest, double off, double others) const {
    const std::string& id = set_.experiments[k].id;
    return {
        rest,
        {{"outlier_experiment",
          {id},
          id + " is not as the others are",
          "it is left out; measure it again",
          fmt::format("the others, which are {:.2g} {} off at most, predict it {:.2g} {} off; no effect that acts on "
                      "all of them, no other unit and no exchange explains it",
                      others / unit_.size, unit_.name, off / unit_.size, unit_.name)}},
        true};
  }

  static constexpr int few_starts = 2;

  const MeasurementSet& set_;
  const MisfitUnit unit_ = set_.unit();
  const Workers& workers_;
  const FittedModel& declared_;
  const Noise& noise_;
  const std::function<void(const std::string&)>& progress_;
};

}  // namespace

std::optional<Mended> find_fault(const MeasurementSet& set, const Workers& workers, const FittedModel& declared,
                                 const Noise& noise, const std::function<void(const std::string&)>& progress) {
  if (set.vessel || !noise.sigma_m) return {};
  return FaultFinder(set, workers, declared, noise, progress).find();
}

}  // namespace ostium::data
