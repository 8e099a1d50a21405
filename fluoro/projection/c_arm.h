#pragma once
/// Geometry of the C-arm: source and detector, and the projection of points onto the detector.
///
/// Frame P: the patient's, x left, y head, z front, metres. Angles as DICOM's positioner angles, which give the
/// detector's direction: primary positive to the patient's left (LAO), secondary positive to the head (CRA); both zero:
/// detector in front of the patient, source behind.
#include <Eigen/Core>
#include <optional>

#include "core/base/units.h"

namespace ostium::fluoro {

struct CArm {
  double lao_rad = 0;   ///< [-pi, pi]; negative: RAO
  double cran_rad = 0;  ///< (-pi/2, pi/2); negative: caudal
  double source_to_isocentre_m = 0.765;
  double source_to_detector_m = 1.1;  ///< SID; larger than source_to_isocentre_m
  Eigen::Vector3d p_PI{0, 0, 0};      ///< the isocentre

  bool operator==(const CArm&) const = default;
};

/// Image axes in the patient frame: right lies in the transverse plane; right x up = outwards, which points from the
/// source to the detector's middle.
struct ImageAxes {
  Eigen::Vector3d right, up, outwards;
  explicit ImageAxes(const CArm& arm);
};

/// Reach of a floor-mounted C-arm: rounded from manufacturers' statements (an estimate: no data sheet is cited).
struct CArmLimits {
  double lao_rad = 120 * units::pi / 180, cran_rad = 55 * units::pi / 180;
  double shortest_sid_m = 0.85, longest_sid_m = 1.25;
};
/// Throws std::invalid_argument naming the values out of their limits, and the limits.
void require_reachable(const CArm& arm, const CArmLimits& limits = {});

/// Unit vector from the isocentre to the middle of the detector.
Eigen::Vector3d towards_detector(const CArm& arm);
/// The focal spot.
Eigen::Vector3d source(const CArm& arm);

/// Detector coordinates of a point, metres from the middle: right as the image is viewed (the patient's left in an AP
/// view), and up (the head). Empty if the point is not in front of the source.
std::optional<Eigen::Vector2d> project(const CArm& arm, const Eigen::Vector3d& p_P);

}  // namespace ostium::fluoro
