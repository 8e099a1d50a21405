#pragma once
/// Predictions of a set's declared model, without fitting: prediction.json (schema ostium-prediction/1) and .csv.
#include "data/identification/forward/shape.h"

namespace ostium::data {

/// What one view sees.
struct ProjectedWire {
  std::string view;  ///< its id
  std::vector<Eigen::Vector2d> points_px;
};

struct Prediction {
  std::string id;
  PredictedShape shape;
  std::optional<double> rms_to_measured_m;  ///< none if registration or offset is free
  /// Tip distances from this shape to the other stable shapes found.
  std::vector<double> other_branches_m;
  MisfitUnit unit = {};  ///< of rms_to_measured_m
  std::vector<ProjectedWire> projections = {};
};

/// Throws LoadError for sets that the model cannot handle (require_known), or naming the experiment without a static
/// shape.
std::vector<Prediction> predict(const MeasurementSet& set,
                                const std::function<void(std::size_t, std::size_t)>& progress = {});

std::string to_json(const std::vector<Prediction>& predictions);
/// Columns experiment, s_mm, x_mm, y_mm, z_mm.
std::string to_csv(const std::vector<Prediction>& predictions);

}  // namespace ostium::data
