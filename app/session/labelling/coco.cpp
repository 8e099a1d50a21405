#include "app/session/labelling/coco.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/units.h"

namespace ostium::app {

namespace {

using Json = nlohmann::ordered_json;

double rounded(double x, double to) { return std::round(x / to) * to; }
/// To a hundredth of a pixel, and to a micrometre.
double px(double x) { return rounded(100 * x, 1) / 100; }
double in_mm(double x_m) { return rounded(1e6 * x_m, 1) / 1000; }
Json in_mm(const Eigen::Vector3d& p_m) { return {in_mm(p_m.x()), in_mm(p_m.y()), in_mm(p_m.z())}; }

bool is_in(const fluoro::View& view, const fluoro::PicturePoint& p) {
  return p.at.minCoeff() >= 0 && p.at.maxCoeff() < view.pixels;
}

Json box_of(const fluoro::View& view, const fluoro::Silhouette& covered) {
  int left = view.pixels, right = -1, top = view.pixels, bottom = -1;
  for (int row = 0; row < view.pixels; ++row)
    for (int column = 0; column < view.pixels; ++column) {
      if (!covered.covers(row, column)) continue;
      left = std::min(left, column), right = std::max(right, column);
      top = std::min(top, row), bottom = std::max(bottom, row);
    }
  return {left, top, right - left + 1, bottom - top + 1};
}

/// Those of its points that are in the picture.
Json centreline_of(const fluoro::View& view, const Eigen::Matrix3Xd& line_P) {
  Json at = Json::array(), depth = Json::array(), space = Json::array();
  for (Eigen::Index i = 0; i < line_P.cols(); ++i) {
    const auto p = picture_point(view, line_P.col(i));
    if (!p || !is_in(view, *p)) continue;
    at.push_back({px(p->at.x()), px(p->at.y())});
    depth.push_back(in_mm(p->depth_m));
    space.push_back(in_mm(Eigen::Vector3d(line_P.col(i))));
  }
  return {{"px", at}, {"depth_mm", depth}, {"mm", space}};
}

}  // namespace

std::string PictureName::picture() const { return fmt::format("images/{}-{:07}.png", run, step); }
std::string PictureName::mask() const { return fmt::format("masks/{}-{:07}.png", run, step); }
std::string PictureName::depth() const { return fmt::format("depth/{}-{:07}.png", run, step); }

std::vector<long> run_lengths(const fluoro::View& view, const fluoro::Silhouette& covered) {
  std::vector<long> counts;
  bool now = false;
  long length = 0;
  for (int column = 0; column < view.pixels; ++column)
    for (int row = 0; row < view.pixels; ++row) {
      if (covered.covers(row, column) != now) counts.push_back(length), length = 0, now = !now;
      ++length;
    }
  counts.push_back(length);
  return counts;
}

Json c_arm_of(const fluoro::View& view) {
  Eigen::Matrix<double, 3, 4> P = projection_matrix(view);
  P.rightCols<1>() *= 1e3;  // of points in mm
  Json rows = Json::array();
  for (int r = 0; r < 3; ++r) rows.push_back({P(r, 0), P(r, 1), P(r, 2), P(r, 3)});
  return {{"lao_deg", view.arm.lao_rad / units::degree},
          {"cran_deg", view.arm.cran_rad / units::degree},
          {"source_to_isocentre_mm", in_mm(view.arm.source_to_isocentre_m)},
          {"source_to_detector_mm", in_mm(view.arm.source_to_detector_m)},
          {"isocentre_mm", in_mm(view.arm.p_PI)},
          {"field_mm", in_mm(view.field_m)},
          {"pixel_mm", 1e3 * view.field_m / view.pixels},
          {"projection", rows}};
}

Json points_of(const fluoro::View& view, const Labels& labels) {
  Json points = Json::array();
  for (const LabelledPoint& point : labels.points)
    if (const auto p = picture_point(view, point.p_P))
      points.push_back({{"name", point.name},
                        {"px", {px(p->at.x()), px(p->at.y())}},
                        {"in_picture", is_in(view, *p)},
                        {"depth_mm", in_mm(p->depth_m)},
                        {"mm", in_mm(point.p_P)}});
  return points;
}

Json image_of(const PictureName& name, const SessionModel& model, const SessionState& state,
              const SessionReport& report, const fluoro::View& view, const Labels& labels) {
  Json tools = Json::array();
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    const ToolReport& tool = report.tools[t];
    if (!tool.in_body) continue;
    tools.push_back({{"name", model.tools[t].name},
                     {"instrument", model.tools[t].instrument.name},
                     {"inserted_mm", in_mm(state.rods.rods[t].inserted_m)},
                     {"push_N", tool.push_N},
                     {"torque_mNm", 1e3 * tool.torque_Nm},
                     {"wall_force_N", tool.wall_force_N},
                     {"tip_force_N", tool.tip_force_N},
                     {"touches", tool.touches}});
  }
  return {{"id", 0},
          {"file_name", name.picture()},
          {"mask", name.mask()},
          {"depth", name.depth()},
          {"width", view.pixels},
          {"height", view.pixels},
          {"run", name.run},
          {"time_s", seconds(model, state)},
          {"heart_phase", state.blood.heart.phase},
          {"breath_depth", breath(model, state)},
          {"c_arm", c_arm_of(view)},
          {"tools", tools},
          {"points", points_of(view, labels)}};
}

std::vector<Json> annotations_of(const fluoro::View& view, const Labels& labels) {
  std::vector<Json> out;
  for (const LabelledThing& thing : labels.things) {
    Json one = {{"id", 0},
                {"image_id", 0},
                {"category_id", thing.category},
                {"name", thing.name},
                {"segmentation", {{"size", {view.pixels, view.pixels}}, {"counts", run_lengths(view, thing.covered)}}},
                {"area", thing.covered.pixels()},
                {"bbox", box_of(view, thing.covered)},
                {"iscrowd", 0}};
    if (thing.tool >= 0) {
      const auto tip = picture_point(view, thing.line_P.rightCols<1>());
      const bool seen = tip && is_in(view, *tip);
      one["keypoints"] = {seen ? px(tip->at.x()) : 0, seen ? px(tip->at.y()) : 0, seen ? 2 : 0};
      one["num_keypoints"] = seen ? 1 : 0;
    }
    if (thing.line_P.cols() > 0) one["centreline"] = centreline_of(view, thing.line_P);
    out.push_back(std::move(one));
  }
  return out;
}

Json categories_of(const std::vector<std::string>& names) {
  Json out = Json::array();
  for (const std::string& name : names) {
    bool tool = false;
    for (std::size_t kind = 0; kind < data::instrument_kinds().size(); ++kind)
      tool |= name == words_for(static_cast<data::InstrumentKind>(kind));
    Json one = {{"id", out.size() + 1},
                {"name", name},
                {"supercategory", tool || name == "balloon" || name == "stent" ? "device" : "vessel"}};
    if (tool) one["keypoints"] = {"tip"}, one["skeleton"] = Json::array();
    out.push_back(std::move(one));
  }
  return out;
}

Json coco_of(const std::vector<Json>& runs, const Json& categories) {
  std::map<std::string, int> number;
  for (const Json& category : categories) number[category.at("name")] = category.at("id");
  Json images = Json::array(), annotations = Json::array();
  for (const Json& run : runs)
    for (const Json& picture : run.at("pictures")) {
      Json image = picture.at("image");
      image["id"] = images.size() + 1;
      for (Json one : picture.at("annotations")) {
        one["id"] = annotations.size() + 1;
        one["image_id"] = image["id"];
        one["category_id"] = number.at(one.at("category_id"));
        annotations.push_back(std::move(one));
      }
      images.push_back(std::move(image));
    }
  return {{"info", {{"description", "Made by ostium dataset: simulated, of nobody"}, {"version", OSTIUM_VERSION}}},
          {"images", images},
          {"annotations", annotations},
          {"categories", categories}};
}

}  // namespace ostium::app
