#pragma once
/// Where the C-arm's source and detector are, and where a point lands on the detector.
///
/// Frame P: the patient's, x left, y head, z front, metres. Angles as in DICOM's positioner angles, which say where the
/// detector is: primary positive to the patient's left (LAO), secondary positive to the head (CRA); both zero: in front
/// of the patient, the source behind.
#include <Eigen/Core>
#include <optional>

namespace ostium {

struct CArm {
  double lao_rad = 0;   ///< [-pi, pi]; negative: RAO
  double cran_rad = 0;  ///< (-pi/2, pi/2); negative: caudal
  double source_to_isocentre_m = 0.765;
  double source_to_detector_m = 1.1;               ///< SID; larger than the former
  Eigen::Vector3d p_PI = Eigen::Vector3d::Zero();  ///< the isocentre
};

/// Unit vector from the isocentre to the middle of the detector.
Eigen::Vector3d towards_detector(const CArm& arm);
/// The focal spot.
Eigen::Vector3d source(const CArm& arm);

/// Detector coordinates of a point, metres from the middle: right as the image is read (the patient's left in an AP
/// view), and up (the head). Empty if the point is not in front of the source.
std::optional<Eigen::Vector2d> project(const CArm& arm, const Eigen::Vector3d& p_P);

}  // namespace ostium
