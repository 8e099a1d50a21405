#pragma once
/// The patient frame P, in which all anatomy is: x to the patient's left, y to the head, z to the front; metres.
/// Files keep their own: millimetres, and DICOM's and 3D Slicer's LPS (left, posterior, superior). These are the only
/// places where one becomes the other.
#include <Eigen/Core>

namespace ostium::vascular {

Eigen::Vector3d patient_from_lps_mm(const Eigen::Vector3d& p_LPS_mm);
Eigen::Vector3d lps_mm_from_patient(const Eigen::Vector3d& p_P);

/// Our own files: the patient frame, in millimetres.
Eigen::Vector3d patient_from_mm(const Eigen::Vector3d& p_P_mm);
Eigen::Vector3d mm_from_patient(const Eigen::Vector3d& p_P);

}  // namespace ostium::vascular
