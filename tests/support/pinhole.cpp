#include "tests/support/pinhole.h"

#include <cmath>
#include <complex>

#include "core/base/units.h"

namespace ostium::synthetic {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// From the AP view (columns along x, rows along z, rays along -y) about z, then tilted in the turned frame.
Matrix3d Pinhole::axes() const {
  const double p = primary_deg * units::degree, s = secondary_deg * units::degree;
  const Matrix3d turned = Eigen::AngleAxisd(p, Vector3d::UnitZ()).toRotationMatrix();
  const Vector3d tilted_ray(0, -std::cos(s), std::sin(s)), tilted_row(0, std::sin(s), std::cos(s));
  Matrix3d out;
  out.row(0) = (turned * Vector3d::UnitX()).transpose();
  out.row(1) = (rows_down ? -1 : 1) * (turned * tilted_row).transpose();
  out.row(2) = (turned * tilted_ray).transpose();
  return out;
}

Vector3d Pinhole::source_m() const {
  return isocentre_m - (source_to_isocentre_m + source_back_m) * axes().row(2).transpose();
}

Vector3d Pinhole::first_pixel_m() const {
  const Vector3d on_axes(-pixel_m * (columns - 1) / 2, -pixel_m * (rows - 1) / 2,
                         source_to_detector_m - source_to_isocentre_m + detector_away_m);
  return isocentre_m + axes().transpose() * on_axes;
}

Vector2d Pinhole::picture_of(const Vector3d& p) const {
  const double focal_px = (source_to_detector_m + source_back_m + detector_away_m) / pixel_m;
  Matrix3d inner;
  inner << focal_px, 0, (columns - 1) / 2.0, 0, focal_px, (rows - 1) / 2.0, 0, 0, 1;
  Eigen::Matrix<double, 3, 4> outer;
  outer << axes(), -axes() * source_m();
  const Vector3d seen = inner * (outer * p.homogeneous());
  const std::complex<double> middle((columns - 1) / 2.0, (rows - 1) / 2.0);
  const std::complex<double> off = std::complex<double>(seen.x(), seen.y()) / seen.z() - middle;
  const double share = std::norm(off) * 4 / (static_cast<double>(columns) * columns);
  const std::complex<double> warped = off * std::polar(1 + barrel * share, turn_at_edge * share);
  return Vector2d((middle + warped).real(), (middle + warped).imag()) + shift_px;
}

}  // namespace ostium::synthetic
