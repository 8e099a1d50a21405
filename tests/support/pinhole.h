#pragma once
/// A C-arm's camera for made-up pictures, by a projection matrix built from its angles: shares nothing with the camera
/// that fits use, nor with the renderer.
#include <Eigen/Geometry>

namespace ostium::synthetic {

/// Frame: x to the patient's left, y to the back, z to the head, metres.
struct Pinhole {
  double primary_deg = 0, secondary_deg = 0;  ///< positive to the patient's left, to the head
  double source_to_detector_m = 1.08, source_to_isocentre_m = 0.765, pixel_m = 0.3e-3;
  int columns = 1024, rows = 1024;
  Eigen::Vector3d isocentre_m = Eigen::Vector3d::Zero();
  bool rows_down = false;  ///< rows count towards the feet
  // What nobody declares.
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
  double source_back_m = 0;             ///< the source farther from the detector
  double detector_away_m = 0;           ///< the detector farther from the source
  double barrel = 0, turn_at_edge = 0;  ///< radial growth, and turn in radians, at half the picture's width

  /// Rows: column axis, row axis, from the source to the detector; a rotation but for the sign of the second.
  Eigen::Matrix3d axes() const;
  Eigen::Vector3d source_m() const;
  Eigen::Vector3d first_pixel_m() const;
  /// Column and row.
  Eigen::Vector2d picture_of(const Eigen::Vector3d& p_m) const;
};

}  // namespace ostium::synthetic
