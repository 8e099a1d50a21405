#include "vascular/anatomy/lumen/courses.h"

#include <algorithm>
#include <cmath>

namespace ostium::vascular {

namespace {

void measure(std::vector<TreeSphere>& spheres) {
  for (std::size_t i = 0; i < spheres.size(); ++i)
    spheres[i].s_m = i ? spheres[i - 1].s_m + (spheres[i].p - spheres[i - 1].p).norm() : 0;
}

}  // namespace

std::vector<Eigen::Vector3d> Course::points(double from_m, double step_m, double most_m) const {
  std::vector<Eigen::Vector3d> result;
  std::size_t i = 0;
  for (double s = from_m; s <= std::min(length_m(), from_m + most_m); s += step_m) {
    while (i + 2 < spheres.size() && spheres[i + 1].s_m < s) ++i;
    const double width = spheres[i + 1].s_m - spheres[i].s_m;
    const double t = width > 0 ? (s - spheres[i].s_m) / width : 0;
    result.push_back(spheres[i].p + t * (spheres[i + 1].p - spheres[i].p));
  }
  return result;
}

double Course::parts_from(const Course& other) const {
  for (const TreeSphere& sphere : spheres) {
    bool near = false;
    for (const TreeSphere& o : other.spheres)
      near = near || (sphere.p - o.p).norm() < std::max(0.8 * o.radius_m, 0.4e-3);
    if (!near) return sphere.s_m;
  }
  return length_m();
}

std::vector<Course> courses_of(const SphereTree& tree) {
  std::vector<Course> courses;
  for (std::size_t b = 0; b < tree.branches.size(); ++b) {
    std::vector<std::vector<TreeSphere>> parts = {tree.branches[b].spheres};
    for (int at = static_cast<int>(b); tree.branches[at].parent >= 0; at = tree.branches[at].parent) {
      const std::vector<TreeSphere>& parent = tree.branches[tree.branches[at].parent].spheres;
      parts.emplace_back(parent.begin(), parent.begin() + tree.branches[at].parent_sphere);
    }
    Course course;
    for (auto part = parts.rbegin(); part != parts.rend(); ++part)
      course.spheres.insert(course.spheres.end(), part->begin(), part->end());
    measure(course.spheres);
    courses.push_back(std::move(course));
  }
  return courses;
}

std::vector<Course> courses_from(const std::vector<Course>& courses, int from) {
  if (from < 0) return courses;
  const std::vector<TreeSphere>& back = courses[static_cast<std::size_t>(from)].spheres;
  std::vector<Course> result;
  for (std::size_t c = 0; c <= courses.size(); ++c) {
    if (static_cast<int>(c) == from) continue;
    std::size_t common = 0;
    Course course;
    if (c < courses.size()) {
      const std::vector<TreeSphere>& out = courses[c].spheres;
      while (common < std::min(back.size(), out.size()) && back[common].p == out[common].p) ++common;
      course.spheres.assign(back.rbegin(), back.rend() - static_cast<long>(common));
      course.spheres.insert(course.spheres.end(), out.begin() + static_cast<long>(common), out.end());
    } else {
      course.spheres.assign(back.rbegin(), back.rend());
    }
    measure(course.spheres);
    if (course.spheres.size() > 1) result.push_back(std::move(course));
  }
  return result;
}

Course beyond(const Course& course, const Course& trunk) {
  std::size_t first = course.spheres.size();
  for (std::size_t i = course.spheres.size(); i-- > 0; first = i) {
    bool inside = false;
    for (const TreeSphere& t : trunk.spheres) inside = inside || (course.spheres[i].p - t.p).norm() < t.radius_m;
    if (inside) break;
  }
  Course rest;
  rest.spheres.assign(course.spheres.begin() + static_cast<long>(first), course.spheres.end());
  measure(rest.spheres);
  return rest;
}

double median_radius(const Course& course) {
  std::vector<double> radii;
  for (const TreeSphere& sphere : course.spheres) radii.push_back(sphere.radius_m);
  if (radii.empty()) return 0;
  std::nth_element(radii.begin(), radii.begin() + static_cast<long>(radii.size() / 2), radii.end());
  return radii[radii.size() / 2];
}

}  // namespace ostium::vascular
