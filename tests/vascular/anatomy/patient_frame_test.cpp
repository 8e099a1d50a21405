#include "vascular/geometry/mesh/patient_frame.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace ostium::vascular {
namespace {

using Eigen::Vector3d;

TEST(PatientFrame, LeftHeadFrontInMetresAndLpsInMillimetres) {
  EXPECT_EQ(patient_from_lps_mm({1000, 0, 0}), Vector3d(1, 0, 0));   // left stays left
  EXPECT_EQ(patient_from_lps_mm({0, 1000, 0}), Vector3d(0, 0, -1));  // posterior is -z
  EXPECT_EQ(patient_from_lps_mm({0, 0, 1000}), Vector3d(0, 1, 0));   // superior is +y
  const Vector3d p(0.12, -0.34, 0.56);
  EXPECT_LT((patient_from_lps_mm(lps_mm_from_patient(p)) - p).norm(), 1e-15);
  EXPECT_LT((patient_from_mm(mm_from_patient(p)) - p).norm(), 1e-15);
}

TEST(PatientFrame, NeitherWayMirrorsThePatient) {
  const Vector3d x = patient_from_lps_mm(Vector3d::UnitX()), y = patient_from_lps_mm(Vector3d::UnitY()),
                 z = patient_from_lps_mm(Vector3d::UnitZ());
  EXPECT_NEAR(1e9 * x.cross(y).dot(z), 1, 1e-12);  // still right-handed
}

}  // namespace
}  // namespace ostium::vascular
