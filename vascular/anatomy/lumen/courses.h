#pragma once
/// Courses: paths through a centreline-sphere tree from its root to its ends, compared for labelling.
#include <vector>

#include "vascular/geometry/centreline/sphere_tree.h"

namespace ostium::vascular {

struct Course {
  std::vector<TreeSphere> spheres;  ///< from the root to the end; s_m from the root
  double length_m() const { return spheres.back().s_m; }
  /// Points every `step_m` from `from_m` to the end, at most over `most_m`.
  std::vector<Eigen::Vector3d> points(double from_m, double step_m, double most_m) const;
  /// Arc length at which two courses from the same root separate by more than their radii.
  double parts_from(const Course& other) const;
};

/// One course per branch of the tree, to its end.
std::vector<Course> courses_of(const SphereTree& tree);

/// All courses from one end to the others: from the end of course `from`, or from the root (-1). The last one leads to
/// the root, unless they begin there.
std::vector<Course> courses_from(const std::vector<Course>& courses, int from);

/// The part of a course outside the wall of another course from the same root; empty if it never leaves it.
Course beyond(const Course& course, const Course& trunk);

double median_radius(const Course& course);

}  // namespace ostium::vascular
