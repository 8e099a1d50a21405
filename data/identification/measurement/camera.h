#pragma once
/// A C-arm's view as a pinhole camera: where its X-ray source and its detector are, in the frame of the set.
///
/// A point is seen where the ray from the source through it meets the detector. Pixels are counted from the centre of
/// the first, which is column 0 and row 0; the picture's middle is ((columns - 1) / 2, (rows - 1) / 2).
#include <Eigen/Core>
#include <vector>

namespace ostium::data {

struct Camera {
  Eigen::Vector3d source_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d pixel_0_0_m = Eigen::Vector3d::Zero();  ///< centre of the pixel of column 0 and row 0
  Eigen::Vector3d u = Eigen::Vector3d::UnitX();           ///< unit, towards higher columns
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();           ///< unit, towards higher rows
  double pixel_m = 0;                                     ///< from one pixel to the next
  int columns = 0, rows = 0;

  /// Warps of the picture about its middle, and a shift; none as declared, only effects change them. With r the
  /// distance from the middle over half the width: radii grow by 1 + pincushion r2, and turn by s_turn_rad r2.
  double pincushion = 0, s_turn_rad = 0;
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();

  Eigen::Vector2d middle_px() const { return {(columns - 1) / 2.0, (rows - 1) / 2.0}; }
  /// Where a pixel's centre lies, in the room.
  Eigen::Vector3d pixel_in_room(const Eigen::Vector2d& px) const {
    return pixel_0_0_m + pixel_m * (px.x() * u + px.y() * v);
  }
  /// Unit, perpendicular to the detector, from the source to it.
  Eigen::Vector3d outwards() const;
  double source_to_detector_m() const { return outwards().dot(pixel_0_0_m - source_m); }
  /// Column and row where a point is seen; not finite unless it is in front of the source.
  Eigen::Vector2d operator()(const Eigen::Vector3d& p_m) const;
};

/// Turns source and detector together about a point.
void turn_about(Camera& camera, const Eigen::Vector3d& centre_m, const Eigen::Matrix3d& R);

/// The point nearest to the rays through the middles of all pictures, and of such points the one nearest to the origin:
/// that about which the C-arm turns.
Eigen::Vector3d isocentre_m(const std::vector<Camera>& cameras);

/// The angles of a C-arm as DICOM's positioner angles, radians: primary towards the patient's left, secondary towards
/// the head. The frame's x goes to the patient's left, y to the back, z to the head.
struct GantryAngles {
  double primary_rad = 0, secondary_rad = 0;
};
GantryAngles gantry_angles(const Eigen::Vector3d& outwards);
/// Unit, from the source to the detector.
Eigen::Vector3d outwards_at(const GantryAngles& angles);
/// The turn from a camera at `from` to where it is after its angles have grown by `more`.
Eigen::Matrix3d gantry_turn(const GantryAngles& from, const GantryAngles& more);

}  // namespace ostium::data
