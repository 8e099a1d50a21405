#include "fluoro/projection/silhouette.h"

#include <algorithm>
#include <array>
#include <cmath>

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

std::optional<PicturePoint> picture_point(const View& view, const Eigen::Vector3d& p_P) {
  const auto on_detector = project(view.arm, p_P);
  if (!on_detector) return {};
  const double scale = view.pixels / view.field_m;
  return PicturePoint{
      Vector2d(0.5 * view.pixels + scale * on_detector->x(), 0.5 * view.pixels - scale * on_detector->y()),
      (p_P - source(view.arm)).dot(towards_detector(view.arm))};
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

Silhouette::Silhouette(const View& view) : view_(view), depth_m_(Plane::Zero(view.pixels, view.pixels)) {}

void Silhouette::cover(int row, int column, double depth_m) {
  float& own = depth_m_(row, column);
  if (own == 0) ++pixels_;
  if (own == 0 || depth_m < own) own = static_cast<float>(depth_m);
}

void Silhouette::add(const Body& body) {
  for (Eigen::Index t = 0; t < body.triangles->cols(); ++t) {
    const Eigen::Vector3i corner = body.triangles->col(t);
    add(body.p_P.col(corner[0]).cast<double>(), body.p_P.col(corner[1]).cast<double>(),
        body.p_P.col(corner[2]).cast<double>());
  }
}

void Silhouette::add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const std::array<std::optional<PicturePoint>, 3> p = {picture_point(view_, a), picture_point(view_, b),
                                                        picture_point(view_, c)};
  if (!p[0] || !p[1] || !p[2]) return;
  const Vector2d u = p[1]->at - p[0]->at, v = p[2]->at - p[0]->at;
  const double area = cross(u, v);
  if (area == 0) return;
  const auto [left, right] = std::minmax({p[0]->at.x(), p[1]->at.x(), p[2]->at.x()});
  const auto [top, bottom] = std::minmax({p[0]->at.y(), p[1]->at.y(), p[2]->at.y()});
  const auto columns = centres_between(left, right, view_.pixels), rows = centres_between(top, bottom, view_.pixels);
  for (int row = rows.first; row <= rows.second; ++row)
    for (int column = columns.first; column <= columns.second; ++column) {
      const Vector2d from = Vector2d(column + 0.5, row + 0.5) - p[0]->at;
      const double of_c = cross(u, from) / area, of_b = cross(from, v) / area;
      if (of_b < 0 || of_c < 0 || of_b + of_c > 1) continue;
      // One over the depth is linear in the picture.
      cover(row, column, 1 / ((1 - of_b - of_c) / p[0]->depth_m + of_b / p[1]->depth_m + of_c / p[2]->depth_m));
    }
}

void Silhouette::add_tube(const Eigen::Matrix3Xd& points_P, std::span<const double> radius_m) {
  const double scale = view_.arm.source_to_detector_m * view_.pixels / view_.field_m;
  for (Eigen::Index i = 0; i + 1 < points_P.cols(); ++i) {
    const auto a = picture_point(view_, points_P.col(i)), b = picture_point(view_, points_P.col(i + 1));
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
