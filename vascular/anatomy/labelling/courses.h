#pragma once
/// Ways through a tree of centrelines, from its root to its ends, as rows of points; used to recognise them.
#include <vector>

#include "vascular/geometry/centreline/sphere_tree.h"

namespace ostium::vascular {

struct Course {
  std::vector<TreeSphere> spheres;  ///< from the root to the end; s_m from the root
  double length_m() const { return spheres.back().s_m; }
  /// Every `step_m` from `from_m` on, as long as it goes, at most `most_m`.
  std::vector<Eigen::Vector3d> points(double from_m, double step_m, double most_m) const;
  /// Arc length at which two courses from one root part by more than their radii.
  double parts_from(const Course& other) const;
};

/// One for each branch of the tree: to its end.
std::vector<Course> courses_of(const SphereTree& tree);

/// All ways from one end to the others: from that of course `from`, or from the root (-1). The last leads to the root,
/// unless that is where they begin.
std::vector<Course> courses_from(const std::vector<Course>& courses, int from);

/// What is left of a course beyond the wall of another one from the same root; empty if it does not leave it.
Course beyond(const Course& course, const Course& trunk);

double median_radius(const Course& course);

}  // namespace ostium::vascular
