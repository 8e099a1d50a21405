#include "data/identification/forward/prediction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "data/formats/csv.h"
#include "data/identification/effects/effect_list.h"
#include "data/identification/forward/insertion.h"
#include "data/identification/forward/misfit.h"
#include "data/identification/forward/projected.h"

namespace ostium::data {

namespace {

using units::mm;

/// Distances to other equilibria, each counted once. They are searched from the straight shape and from straight shapes
/// in which an instrument is pre-twisted against the others towards its tip, in either direction.
std::vector<double> other_branches(const ExperimentSetup& setup, const PredictedShape& shape) {
  StaticEquilibrium straight{make_concentric(setup.nest, setup.gravity_m_s2), {}, false};
  straight.state = straight_state(straight.nest, setup.base);
  std::vector<StaticEquilibrium> starts = {straight};
  const Eigen::Index elements = straight.state.roll_rad.cols();
  for (std::size_t i = 0; setup.nest.parts.size() > 1 && i < setup.nest.parts.size(); ++i)
    for (const double wound : {-units::pi, units::pi}) {
      if (static_cast<int>(i) == straight.nest.reference) continue;
      StaticEquilibrium other = straight;
      other.state.roll_rad.row(static_cast<Eigen::Index>(i)) += Eigen::RowVectorXd::LinSpaced(elements, 0, wound);
      starts.push_back(other);
    }
  std::vector<Eigen::Vector3d> tips = {shape.points_m.back()};
  std::vector<double> apart;
  for (const StaticEquilibrium& start : starts) {
    const PredictedShape other = shape_from(setup, start);
    if (!other.converged) continue;
    const Eigen::Vector3d tip = other.points_m.back();
    if (std::any_of(tips.begin(), tips.end(), [&](const Eigen::Vector3d& t) { return (t - tip).norm() < 0.1 * mm; }))
      continue;
    tips.push_back(tip);
    apart.push_back((tip - tips.front()).norm());
  }
  return apart;
}

/// Rounded to a millionth of a unit: of a mm, that is the solver's accuracy.
double rounded(double x) { return std::round(x * 1e6) / 1e6 + 0.0; }

}  // namespace

std::vector<Prediction> predict(const MeasurementSet& set,
                                const std::function<void(std::size_t, std::size_t)>& progress) {
  require_known(set);
  Changes declared;
  declared.effects = declared_effects(set);
  std::vector<StaticEquilibrium> anchors;
  std::vector<PredictedShape> inserted;
  if (set.vessel)
    inserted = insert(set, declared, progress);
  else
    anchors = walk(set, declared, progress);
  const bool comparable = !set.imaging.registration_free && !set.imaging.tip_offset_free;
  std::vector<Prediction> predictions;
  for (std::size_t i = 0; i < set.experiments.size(); ++i) {
    const Experiment& e = set.experiments[i];
    const ExperimentSetup setup = setup_of(set, e, declared);
    PredictedShape shape = set.vessel ? inserted[i] : shape_from(setup, anchors[i]);
    if (!set.vessel) add_later_views(set, e, declared, fine_elements_m, anchors[i], shape);
    if (!shape.converged) throw LoadError(no_static_shape(set, e, setup));
    const MeasuredView view = seen(set, e, declared, {});
    Prediction p{e.id, shape, {}, set.vessel ? std::vector<double>{} : other_branches(setup, shape), set.unit(), {}};
    for (std::size_t v = 0; v < set.views.size(); ++v)
      p.projections.push_back({set.views[v].id, projected_px(shape, view, static_cast<int>(v))});
    if (comparable) p.rms_to_measured_m = rms({&e}, {misfit(e, shape, view)});
    for (Eigen::Vector3d& q : p.shape.points_m) q = view(q);
    predictions.push_back(std::move(p));
  }
  return predictions;
}

std::string to_json(const std::vector<Prediction>& predictions) {
  auto list = nlohmann::ordered_json::array();
  for (const Prediction& p : predictions) {
    auto points = nlohmann::ordered_json::array();
    for (const Eigen::Vector3d& q : p.shape.points_m)
      points.push_back({rounded(q.x() / mm), rounded(q.y() / mm), rounded(q.z() / mm)});
    nlohmann::ordered_json entry = {{"id", p.id}, {"centreline_mm", std::move(points)}};
    for (const ProjectedWire& seen : p.projections) {
      auto pixels = nlohmann::ordered_json::array();
      for (const Eigen::Vector2d& q : seen.points_px) pixels.push_back({rounded(q.x()), rounded(q.y())});
      entry["projections"].push_back({{"view", seen.view}, {"polyline_px", std::move(pixels)}});
    }
    auto& rms = entry["rms_to_measured_" + p.unit.name] = nullptr;
    if (p.rms_to_measured_m) rms = rounded(*p.rms_to_measured_m / p.unit.size);
    list.push_back(std::move(entry));
  }
  return nlohmann::ordered_json{{"schema", "ostium-prediction/1"}, {"experiments", std::move(list)}}.dump(1) + "\n";
}

std::string to_csv(const std::vector<Prediction>& predictions) {
  std::string out = "experiment,s_mm,x_mm,y_mm,z_mm\n";
  for (const Prediction& p : predictions) {
    const std::string id = csv_field(p.id);
    double s = 0;
    for (std::size_t i = 0; i < p.shape.points_m.size(); ++i) {
      const Eigen::Vector3d& q = p.shape.points_m[i];
      if (i > 0) s += (q - p.shape.points_m[i - 1]).norm();
      out += fmt::format("{},{:.6f},{:.6f},{:.6f},{:.6f}\n", id, s / mm, q.x() / mm, q.y() / mm, q.z() / mm);
    }
  }
  return out;
}

}  // namespace ostium::data
