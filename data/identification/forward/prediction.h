#pragma once
/// What a set's declared model predicts, nothing fitted: prediction.json (schema ostium-prediction/1) and .csv.
#include "data/identification/forward/shape.h"

namespace ostium::data {

struct Prediction {
  std::string id;
  PredictedShape shape;
  std::optional<double> rms_to_measured_m;  ///< none where registration or offset is free
  /// How far the ends of other stable shapes, those that were found, lie from this one's.
  std::vector<double> other_branches_m;
};

/// Throws LoadError for what the model does not know (require_known), or names the experiment that has no static shape.
std::vector<Prediction> predict(const MeasurementSet& set,
                                const std::function<void(std::size_t, std::size_t)>& progress = {});

std::string to_json(const std::vector<Prediction>& predictions);
/// Columns experiment, s_mm, x_mm, y_mm, z_mm.
std::string to_csv(const std::vector<Prediction>& predictions);

}  // namespace ostium::data
