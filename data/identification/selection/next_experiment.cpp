#include "data/identification/selection/next_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/units.h"
#include "data/identification/forward/projected.h"
#include "data/identification/parallel/workers.h"

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

constexpr int points = 40;  // that are compared along a shape

/// Evenly over a curve's points, the pixels of a view as points of a plane.
void add_projected(const PredictedShape& shape, const MeasuredView& view, std::vector<Eigen::Vector3d>& out) {
  for (std::size_t v = 0; v < view.cameras.size(); ++v) {
    const std::vector<Eigen::Vector2d> px = projected_px(shape, view, static_cast<int>(v));
    for (int k = 0; k <= points; ++k) {
      const Eigen::Vector2d& at = px[static_cast<std::size_t>(k) * (px.size() - 1) / points];
      out.emplace_back(at.x(), at.y(), 0);
    }
  }
}

/// The points that would be measured: the centreline, what the views see of it, or only the tracked tip.
std::vector<Eigen::Vector3d> predicted(const MeasurementSet& set, const Experiment& e, const FittedModel& model,
                                       bool& found) {
  MeasurementSet alone = set;
  alone.experiments = {e};
  const std::vector<StaticEquilibrium> anchors = walk(alone, model.changes);
  PredictedShape shape = shape_from(setup_of(alone, alone.experiments[0], model.changes), anchors[0]);
  add_later_views(alone, alone.experiments[0], model.changes, fine_elements_m, anchors[0], shape);
  found = found && shape.converged;
  const MeasuredView view = seen(set, e, model.changes, model.view);
  if (e.kind == Experiment::Kind::tip) return {tracked_tip(shape, view)};
  std::vector<Eigen::Vector3d> out;
  if (e.kind == Experiment::Kind::projections) {
    add_projected(shape, view, out);
    return out;
  }
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
  const MisfitUnit unit = set.unit();
  if (next.difference_m < std::max(2 * noise.sigma_m.value_or(0), 0.1 * unit.size)) return {};
  next.why = fmt::format("{} and {} predict shapes up to {:.2g} {} apart with {}", a.name, b.name,
                         next.difference_m / unit.size, unit.name, setting_in_words(set, list[best]));
  return next;
}

}  // namespace ostium::data
