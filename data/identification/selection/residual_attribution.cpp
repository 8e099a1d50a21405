#include "data/identification/selection/residual_attribution.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "data/identification/estimation/model_fit.h"
#include "data/identification/selection/evidence.h"
#include "data/identification/selection/residual_fields.h"

namespace ostium::data {

namespace {

constexpr double widths[] = {1.0, 0.25, 4.0};  // of a field's prior
constexpr std::size_t widths_in_vessel = 1;    // each takes a hundred histories and more

/// The stretch between knots that holds four fifths of a field's sum of squares.
std::optional<Eigen::Vector2d> stretch_of(const MeasurementSet& set, const std::vector<double>& v, int width) {
  Eigen::VectorXd squares(field_knots);
  for (int k = 0; k < field_knots; ++k) {
    squares[k] = 0;
    for (int c = 0; c < width; ++c) squares[k] += v[width * k + c] * v[width * k + c];
  }
  for (int length = 1; length <= field_knots; ++length)
    for (int first = 0; first + length <= field_knots; ++first)
      if (squares.segment(first, length).sum() >= 0.8 * squares.sum()) {
        const double half = 0.5 * field_knot(set, 1), end = field_knot(set, field_knots - 1);
        return Eigen::Vector2d(std::max(field_knot(set, first) - half, 0.0),
                               std::min(field_knot(set, first + length - 1) + half, end));
      }
  return {};
}

/// The point on the model's shapes at the middle of a force field, if it is the same in all experiments to within a
/// quarter of the longest insertion.
std::optional<Eigen::Vector3d> place_of(const MeasurementSet& set, const FittedModel& model,
                                        const Eigen::Vector2d& stretch) {
  std::vector<Eigen::Vector3d> at;
  const double middle = 0.5 * (stretch.x() + stretch.y());
  for (const PredictedShape& shape : model.shapes) {
    double from_tip = 0;
    for (std::size_t i = shape.points_m.size() - 1; i > 0; --i) {
      from_tip += (shape.points_m[i] - shape.points_m[i - 1]).norm();
      if (from_tip < middle) continue;
      at.push_back(shape.points_m[i - 1]);
      break;
    }
  }
  if (at.empty()) return {};
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : at) mean += p / static_cast<double>(at.size());
  double scatter = 0;
  for (const Eigen::Vector3d& p : at) scatter += (p - mean).squaredNorm() / static_cast<double>(at.size());
  if (std::sqrt(scatter) > 0.25 * field_knot(set, field_knots - 1)) return {};
  return mean;
}

}  // namespace

std::vector<ResidualAttribution> attribute_residual(const MeasurementSet& set, const Workers& workers,
                                                    const FittedModel& near, const std::vector<ActiveEffect>& with,
                                                    const Noise& noise,
                                                    const std::function<void(const std::string&)>& progress) {
  struct CandidateField {
    const Effect* effect;
    const char *frame, *what;
    int width;
  };
  const CandidateField fields[] = {{&rest_curvature_field(), "material", "rest curvature of the instrument", 2},
                                   {&lateral_force_field(), "lab", "a force that stays where it is in the room", 3},
                                   {&image_field(), "image", "a rigid or affine error of the picture", 0},
                                   {&time_field(), "time", "a change with time", 0}};
  // All against the same noise; if it is unknown, the residual.
  const double sigma = noise.sigma_m.value_or(near.rms_m / std::sqrt(3.0));
  std::vector<ResidualAttribution> out;
  if (set.experiments.size() < 2) return out;
  for (const CandidateField& field : fields) {
    const bool radii = std::all_of(set.experiments.begin(), set.experiments.end(),
                                   [](const Experiment& e) { return e.kind == Experiment::Kind::radius; });
    if (radii && field.effect == &lateral_force_field()) continue;
    std::optional<ResidualAttribution> best;
    FittedModel from = near;
    const std::size_t tried = set.vessel ? widths_in_vessel : std::size(widths);
    for (const double spread : std::span(widths).first(tried)) {  // each starts from the previous result
      std::vector<ActiveEffect> effects = with;
      effects.push_back(active(*field.effect, set, {}, {"", {}}));
      ModelFit study(set, workers, effects, progress, spread);
      study.weigh_by(noise);
      FittedModel model;
      try {
        model = study.run_near(from, sigma, 0, 0);
      } catch (const std::runtime_error&) {
        continue;
      }
      from = model;
      ResidualAttribution trace;
      trace.frame = field.frame, trace.what = field.what;
      trace.log_evidence = study.log_evidence();
      if (best && best->log_evidence > trace.log_evidence) continue;
      study.judge(model, noise);
      const double ratio = model.rms_m / near.rms_m;
      trace.removed = noise.sigma_m ? share_removed(misfit_of(near), misfit_of(model)).value_or(0)
                                    : std::clamp(1 - ratio * ratio, 0.0, 1.0);
      trace.rms_m = model.rms_m;
      for (const FittedParameter& p : model.parameters)
        if (p.parameter.name.starts_with(field.effect->id)) trace.numbers_used += p.informed;
      if (field.width > 0) {
        trace.from_tip_m = stretch_of(set, model.changes.effects.back().values, field.width);
        if (field.effect == &lateral_force_field() && trace.from_tip_m)
          trace.at_m = place_of(set, model, *trace.from_tip_m);
      }
      best = trace;
    }
    if (best) out.push_back(*best);
  }
  ModelFit plain(set, workers, with, progress);
  plain.weigh_by(noise);
  plain.run_near(near, sigma, 0, 0);
  for (ResidualAttribution& t : out) t.log_evidence -= plain.log_evidence();
  std::sort(out.begin(), out.end(),
            [](const ResidualAttribution& a, const ResidualAttribution& b) { return a.log_evidence > b.log_evidence; });
  return out;
}

double convincing_log_evidence(const std::vector<ResidualAttribution>& attributions) {
  const double looks = static_cast<double>(std::max<std::size_t>(attributions.size(), 1) * std::size(widths));
  return strong_evidence / 2 + std::log(looks);
}

Signature signature_of(const std::vector<ResidualAttribution>& attributions) {
  Signature out;
  if (attributions.empty() || attributions.front().log_evidence < convincing_log_evidence(attributions) ||
      attributions.front().removed < part_of_it)
    return out;
  const ResidualAttribution& best = attributions.front();
  out.frame = best.frame;
  out.from_tip_m = best.from_tip_m, out.at_m = best.at_m;
  if (best.at_m) out.from_tip_m.reset();
  return out;
}

}  // namespace ostium::data
