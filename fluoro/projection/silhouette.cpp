#include "fluoro/projection/silhouette.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ostium::fluoro {

namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The pixels whose centres lie between two coordinates, cut off at the picture's edges.
std::pair<int, int> centres_between(double low, double high, int pixels) {
  const double most = pixels;
  return {static_cast<int>(std::ceil(std::clamp(low, 0.0, most) - 0.5)),
          std::min(pixels - 1, static_cast<int>(std::floor(std::clamp(high, -1.0, most) - 0.5)))};
}

}  // namespace

PointProjector::PointProjector(const View& view)
    : axes_(view.arm),
      p_PS_(source(view.arm)),
      middle_(0.5 * view.pixels),
      scale_(view.pixels / view.field_m),
      to_detector_m_(view.arm.source_to_detector_m) {}

std::optional<PicturePoint> PointProjector::operator()(const Eigen::Vector3d& p_P) const {
  const Eigen::Vector3d ray = p_P - p_PS_;
  const double depth_m = ray.dot(axes_.outwards);
  if (!(depth_m > 0)) return {};
  const Vector2d on_detector = to_detector_m_ / depth_m * Vector2d(ray.dot(axes_.right), ray.dot(axes_.up));
  return PicturePoint{Vector2d(middle_ + scale_ * on_detector.x(), middle_ - scale_ * on_detector.y()), depth_m};
}

std::optional<PicturePoint> picture_point(const View& view, const Eigen::Vector3d& p_P) {
  return PointProjector(view)(p_P);
}

Eigen::Matrix<double, 3, 4> projection_matrix(const View& view) {
  const ImageAxes axes(view.arm);
  const double scale = view.arm.source_to_detector_m * view.pixels / view.field_m, middle = 0.5 * view.pixels;
  Eigen::Matrix3d turn;
  turn.row(0) = scale * axes.right + middle * axes.outwards;
  turn.row(1) = -scale * axes.up + middle * axes.outwards;
  turn.row(2) = axes.outwards;
  Eigen::Matrix<double, 3, 4> out;
  out << turn, -turn * source(view.arm);
  return out;
}

Silhouette::Silhouette(const View& view)
    : view_(view), to_picture_(view), depth_m_(Plane::Zero(view.pixels, view.pixels)) {}

void Silhouette::cover(int row, int column, double depth_m) {
  float& own = depth_m_(row, column);
  if (own == 0) ++pixels_;
  if (own == 0 || depth_m < own) own = static_cast<float>(depth_m);
}

void Silhouette::add(const Body& body) {
  std::vector<Corner> at;
  at.reserve(static_cast<std::size_t>(body.p_P.cols()));
  for (Eigen::Index v = 0; v < body.p_P.cols(); ++v) at.push_back(to_picture_(body.p_P.col(v).cast<double>()));
  const auto of = [&](int vertex) -> const Corner& { return at[static_cast<std::size_t>(vertex)]; };
  for (Eigen::Index t = 0; t < body.triangles->cols(); ++t) {
    const Eigen::Vector3i corner = body.triangles->col(t);
    add(of(corner[0]), of(corner[1]), of(corner[2]));
  }
}

void Silhouette::add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  add(to_picture_(a), to_picture_(b), to_picture_(c));
}

void Silhouette::add(const Corner& a, const Corner& b, const Corner& c) {
  if (!a || !b || !c) return;
  const Vector2d u = b->at - a->at, v = c->at - a->at;
  const double area = cross(u, v);
  if (area == 0) return;
  const auto [left, right] = std::minmax({a->at.x(), b->at.x(), c->at.x()});
  const auto [top, bottom] = std::minmax({a->at.y(), b->at.y(), c->at.y()});
  const auto columns = centres_between(left, right, view_.pixels), rows = centres_between(top, bottom, view_.pixels);
  for (int row = rows.first; row <= rows.second; ++row)
    for (int column = columns.first; column <= columns.second; ++column) {
      const Vector2d from = Vector2d(column + 0.5, row + 0.5) - a->at;
      const double of_c = cross(u, from) / area, of_b = cross(from, v) / area;
      if (of_b < 0 || of_c < 0 || of_b + of_c > 1) continue;
      // One over the depth is linear in the picture.
      cover(row, column, 1 / ((1 - of_b - of_c) / a->depth_m + of_b / b->depth_m + of_c / c->depth_m));
    }
}

void Silhouette::add_tube(const Eigen::Matrix3Xd& points_P, std::span<const double> radius_m) {
  const double scale = view_.arm.source_to_detector_m * view_.pixels / view_.field_m;
  for (Eigen::Index i = 0; i + 1 < points_P.cols(); ++i) {
    const auto a = to_picture_(points_P.col(i)), b = to_picture_(points_P.col(i + 1));
    if (!a || !b) continue;
    const Vector2d run = b->at - a->at;
    const double from_px = std::max(0.5, radius_m[static_cast<std::size_t>(i)] * scale / a->depth_m),
                 to_px = std::max(0.5, radius_m[static_cast<std::size_t>(i) + 1] * scale / b->depth_m),
                 reach = std::max(from_px, to_px);
    const auto columns =
        centres_between(std::min(a->at.x(), b->at.x()) - reach, std::max(a->at.x(), b->at.x()) + reach, view_.pixels);
    const auto rows =
        centres_between(std::min(a->at.y(), b->at.y()) - reach, std::max(a->at.y(), b->at.y()) + reach, view_.pixels);
    for (int row = rows.first; row <= rows.second; ++row)
      for (int column = columns.first; column <= columns.second; ++column) {
        const Vector2d from = Vector2d(column + 0.5, row + 0.5) - a->at;
        const double share = run.squaredNorm() > 0 ? std::clamp(from.dot(run) / run.squaredNorm(), 0.0, 1.0) : 0.0;
        if ((from - share * run).norm() > (1 - share) * from_px + share * to_px) continue;
        cover(row, column, 1 / ((1 - share) / a->depth_m + share / b->depth_m));
      }
  }
}

}  // namespace ostium::fluoro
