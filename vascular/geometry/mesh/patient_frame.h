#pragma once
/// The patient frame P of all anatomy: x to the patient's left, y to the head, z to the front; metres. Files use other
/// frames: millimetres, and the LPS (left, posterior, superior) of DICOM and 3D Slicer. All conversions are here.
#include <Eigen/Core>

namespace ostium::vascular {

Eigen::Vector3d patient_from_lps_mm(const Eigen::Vector3d& p_LPS_mm);
Eigen::Vector3d lps_mm_from_patient(const Eigen::Vector3d& p_P);

/// Our own files use the patient frame, in millimetres.
Eigen::Vector3d patient_from_mm(const Eigen::Vector3d& p_P_mm);
Eigen::Vector3d mm_from_patient(const Eigen::Vector3d& p_P);

}  // namespace ostium::vascular
