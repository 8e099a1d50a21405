#pragma once
/// The courses of the mean anatomy that others are compared with.
#include "vascular/anatomy/anatomy.h"
#include "vascular/anatomy/labelling/courses.h"

namespace ostium::vascular {

struct MeanCourses {
  Anatomy anatomy;
  Course aorta;          ///< from the root to the right groin
  Course lad, lcx, rca;  ///< from the ostium to the end, the left main included
};

MeanCourses mean_courses();

}  // namespace ostium::vascular
