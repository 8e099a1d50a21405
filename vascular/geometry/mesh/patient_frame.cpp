#include "vascular/geometry/mesh/patient_frame.h"

namespace ostium::vascular {

namespace {
constexpr double mm_per_m = 1e3;
}

Eigen::Vector3d patient_from_lps_mm(const Eigen::Vector3d& p_LPS_mm) {
  return Eigen::Vector3d(p_LPS_mm.x(), p_LPS_mm.z(), -p_LPS_mm.y()) / mm_per_m;
}

Eigen::Vector3d lps_mm_from_patient(const Eigen::Vector3d& p_P) {
  return mm_per_m * Eigen::Vector3d(p_P.x(), -p_P.z(), p_P.y());
}

Eigen::Vector3d patient_from_mm(const Eigen::Vector3d& p_P_mm) { return p_P_mm / mm_per_m; }

Eigen::Vector3d mm_from_patient(const Eigen::Vector3d& p_P) { return mm_per_m * p_P; }

}  // namespace ostium::vascular
