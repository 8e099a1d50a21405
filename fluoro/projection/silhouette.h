#pragma once
/// Which pixels a thing covers, and how far from the source it is there: labels for pictures, not pictures. Whatever
/// covers a pixel's centre covers the pixel; an instrument thinner than a pixel covers those that its axis crosses.
#include <Eigen/Core>
#include <optional>
#include <span>

#include "fluoro/base/plane.h"
#include "fluoro/matter/scene.h"
#include "fluoro/projection/path_lengths.h"

namespace ostium::fluoro {

/// A point in a picture.
struct PicturePoint {
  Eigen::Vector2d at;  ///< pixels from the upper left corner: column, row; centres of pixels at one half
  double depth_m = 0;  ///< from the source, along the direction to the detector's middle
};
/// Where points come to lie in the pictures of a view.
class PointProjector {
 public:
  explicit PointProjector(const View& view);
  /// Empty if the point is not in front of the source. It may lie outside of the picture.
  std::optional<PicturePoint> operator()(const Eigen::Vector3d& p_P) const;

 private:
  ImageAxes axes_;
  Eigen::Vector3d p_PS_;  ///< the source
  double middle_, scale_, to_detector_m_;
};
/// Of a single point.
std::optional<PicturePoint> picture_point(const View& view, const Eigen::Vector3d& p_P);

/// The same as a matrix: column, row and 1 are in the ratio of P (x, y, z, 1), metres.
Eigen::Matrix<double, 3, 4> projection_matrix(const View& view);

class Silhouette {
 public:
  explicit Silhouette(const View& view);
  void add(const Body& body);  ///< all its triangles
  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
  /// A tube about the points, with a radius at each and round ends.
  void add_tube(const Eigen::Matrix3Xd& points_P, std::span<const double> radius_m);

  bool empty() const { return pixels_ == 0; }
  long pixels() const { return pixels_; }  ///< covered
  bool covers(int row, int column) const { return depth_m_(row, column) > 0; }
  /// Of the nearest surface at each pixel (of tubes: the axis); 0: not covered.
  const Plane& depth_m() const { return depth_m_; }

 private:
  using Corner = std::optional<PicturePoint>;
  void cover(int row, int column, double depth_m);
  void add(const Corner& a, const Corner& b, const Corner& c);

  View view_;
  PointProjector to_picture_;
  Plane depth_m_;
  long pixels_ = 0;
};

}  // namespace ostium::fluoro
