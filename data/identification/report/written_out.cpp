#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "data/identification/report/explanation_report.h"

namespace ostium::data {

namespace {

using Json = nlohmann::ordered_json;
using units::mm;

Json in_mm(const Eigen::Vector3d& p_m) { return {p_m.x() / mm, p_m.y() / mm, p_m.z() / mm}; }
Json axis(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json geometry_of(const MeasuredCArm& arm) {
  const Camera& c = arm.camera;
  return {{"id", arm.id},
          {"source_mm", in_mm(c.source_m)},
          {"pixel_0_0_mm", in_mm(c.pixel_0_0_m)},
          {"u", axis(c.u)},
          {"v", axis(c.v)},
          {"pixel_mm", c.pixel_m / mm},
          {"rows", c.rows},
          {"columns", c.columns}};
}

Json projections_of(const MeasurementSet& set, const Experiment& e) {
  Json out = Json::array();
  for (const ClickedPolyline& polyline : e.polylines) {
    Json points = Json::array();
    for (const Eigen::Vector2d& p : polyline.points_px) points.push_back({p.x(), p.y()});
    out.push_back({{"view", set.views[polyline.view].id}, {"polyline_px", std::move(points)}});
  }
  return out;
}

}  // namespace

std::string written_out(const std::string& text, const MeasurementSet& set) {
  Json file = Json::parse(text);
  for (std::size_t v = 0; v < set.views.size(); ++v)
    if (file["views"][v].contains("dicom")) file["views"][v] = geometry_of(set.views[v]);
  if (file.erase("polylines_csv") > 0)
    for (std::size_t e = 0; e < set.experiments.size(); ++e)
      file["experiments"][e]["projections"] = projections_of(set, set.experiments[e]);
  return file.dump(1) + "\n";
}

}  // namespace ostium::data
