#include "data/identification/selection/next_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/units.h"
#include "data/identification/estimation/workers.h"

namespace ostium::data {

namespace {

using units::degree;

/// Settings around those of the set: rolls a quarter turn apart and insertions from 0.5 to 1.5 times, varied for one
/// instrument at a time.
std::vector<Experiment> settings(const MeasurementSet& set) {
  std::vector<Experiment> out;
  std::vector<const Experiment*> from = {&set.experiments.front()};
  for (const Experiment& e : set.experiments)
    if (e.set.back().inserted_m > from.back()->set.back().inserted_m) from.push_back(&e);
  from = {from.front(), from.back()};
  for (const Experiment* e : from)
    for (std::size_t i = 0; i < e->set.size(); ++i)
      for (const double turn : {0.0, 90.0, 180.0, -90.0})
        for (const double length : {0.5, 0.75, 1.0, 1.25, 1.5}) {
          Experiment other = *e;
          Placement& p = other.set[i];
          const double whole = set.instruments[i].length_m, drive = p.inserted_m + p.shaft_m;
          p.roll_rad += turn * degree;
          // The drive moves with the instrument; otherwise the shaft's length would change.
          p.inserted_m = std::min(p.inserted_m * length, p.shaft_m > 0 ? std::min(drive, whole) : whole);
          if (p.shaft_m > 0) p.shaft_m = std::max(drive - p.inserted_m, 0.0);
          out.push_back(other);
        }
  return out;
}

/// The points that would be measured: the centreline, or only the tracked tip.
std::vector<Eigen::Vector3d> predicted(const MeasurementSet& set, const Experiment& e, const FittedModel& model,
                                       bool& found) {
  MeasurementSet alone = set;
  alone.experiments = {e};
  const std::vector<StaticEquilibrium> anchors = walk(alone, model.changes);
  const PredictedShape shape = shape_from(setup_of(alone, alone.experiments[0], model.changes), anchors[0]);
  found = found && shape.converged;
  const MeasuredView view = seen(set, e, model.changes, model.view);
  if (e.kind == Experiment::Kind::tip) return {tracked_tip(shape, view)};
  std::vector<Eigen::Vector3d> out;
  constexpr int points = 40;
  for (int k = 0; k <= points; ++k) {
    const auto at = static_cast<std::size_t>(k * (static_cast<int>(shape.points_m.size()) - 1) / points);
    out.push_back(view(shape.points_m[at]));
  }
  return out;
}

std::string setting_in_words(const MeasurementSet& set, const Experiment& e) {
  std::string out;
  for (std::size_t i = 0; i < e.set.size(); ++i)
    out += fmt::format("{}{} inserted {:.0f} mm and rolled by {:.0f} degrees", i == 0 ? "" : ", ",
                       set.instruments[i].name, 1e3 * e.set[i].inserted_m, e.set[i].roll_rad / degree);
  return out;
}

}  // namespace

std::optional<NextExperiment> next_experiment(const MeasurementSet& set, const Workers& workers, const FittedModel& a,
                                              const FittedModel& b, const Noise& noise) {
  if (set.vessel) return {};
  const std::vector<Experiment> list = settings(set);
  const auto differences = workers.map(list.size(), [&](std::size_t i) -> std::vector<double> {
    bool found = true;
    try {
      const auto pa = predicted(set, list[i], a, found), pb = predicted(set, list[i], b, found);
      double most = 0;
      for (std::size_t k = 0; k < pa.size(); ++k) most = std::max(most, (pa[k] - pb[k]).norm());
      return {found ? most : 0};
    } catch (const std::invalid_argument&) {
      return {0};
    }
  });
  std::size_t best = 0;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (differences[i][0] > differences[best][0]) best = i;
  NextExperiment next;
  next.difference_m = differences[best][0];
  next.set = list[best].set;
  if (next.difference_m < std::max(2 * noise.sigma_m.value_or(0), 0.1e-3)) return {};
  next.why = fmt::format("{} and {} predict shapes up to {:.2g} mm apart with {}", a.name, b.name,
                         1e3 * next.difference_m, setting_in_words(set, list[best]));
  return next;
}

}  // namespace ostium::data
