#pragma once
/// Courses of the mean anatomy, the reference for labelling.
#include "vascular/anatomy/anatomy.h"
#include "vascular/anatomy/lumen/courses.h"

namespace ostium::vascular {

struct MeanCourses {
  Anatomy anatomy;
  Course aorta;          ///< from the root to the right groin
  Course lad, lcx, rca;  ///< from the ostium to the end, including the left main
};

MeanCourses mean_courses();

}  // namespace ostium::vascular
