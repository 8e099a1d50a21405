#pragma once
/// Courses of the mean anatomy, the reference for labelling.
#include "vascular/anatomy/anatomy.h"
#include "vascular/anatomy/lumen/courses.h"

namespace ostium::vascular {

struct MeanCourses {
  Anatomy anatomy;
  Course aorta;          ///< from the root to the right groin
  Course lad, lcx, rca;  ///< from the ostium to the end, including the left main
  struct Leaving {
    Eigen::Vector3d p, direction;  ///< on the aorta's wall, and unit, over the first 20 mm
  };
  std::vector<Leaving> arch;  ///< where the arch's branches leave it
};

MeanCourses mean_courses();

}  // namespace ostium::vascular
