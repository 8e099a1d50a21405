#include "vascular/anatomy/labelling/coronary_trunks.h"

#include <algorithm>

#include "core/base/units.h"

namespace ostium::vascular {

namespace {

using units::mm;
constexpr double coronary_radius_m = 3.5e-3;  // upper limit for a coronary artery
constexpr double coronary_length_m = 25e-3;   // lower limit for its length
constexpr double end_m = 6e-3;                // what counts as near an end
constexpr double root_m = 75e-3;              // largest distance of its origin from the root

bool like_coronary(const Course& course) {
  if (course.spheres.size() < 4 || course.length_m() < coronary_length_m) return false;
  std::vector<double> first;
  for (const TreeSphere& sphere : course.spheres)
    if (sphere.s_m > 3 * mm && sphere.s_m < 20 * mm) first.push_back(sphere.radius_m);
  if (first.empty()) return false;
  std::nth_element(first.begin(), first.begin() + static_cast<long>(first.size() / 2), first.end());
  return first[first.size() / 2] < coronary_radius_m && median_radius(course) < coronary_radius_m;
}

/// Of the widest sphere near an end: the last one may be tiny, in the tip of a rounded end.
double radius_near_end(const Course& course, bool front) {
  double widest = 0;
  for (const TreeSphere& sphere : course.spheres)
    if ((front ? sphere.s_m : course.length_m() - sphere.s_m) < end_m) widest = std::max(widest, sphere.radius_m);
  return widest;
}

void add_aortic_trunks(const LumenPart& part, const AortaMatch& aorta, std::vector<Trunk>& trunks) {
  for (const Course& course : part.courses) {
    const Course rest = beyond(course, aorta.course);
    if (!like_coronary(rest) || course.length_m() - rest.length_m() > root_m) continue;
    std::size_t t = 0;
    while (t < trunks.size() && (trunks[t].courses[0].spheres[0].p - rest.spheres[0].p).norm() >= 4 * mm) ++t;
    if (t == trunks.size()) trunks.push_back({0, part.root, {}, {}});
    trunks[t].ends.push_back(course.spheres.back().p);
    trunks[t].courses.push_back(rest);
  }
}

/// A part separate from the aorta: any of its wider ends may be the ostium.
void add_loose_trunks(const LumenPart& part, std::size_t p, std::vector<Trunk>& trunks) {
  const std::vector<Course>& courses = part.courses;
  double widest = 0;
  for (const Course& course : courses)
    for (const bool front : {true, false}) widest = std::max(widest, radius_near_end(course, front));
  for (int from = -1; from < static_cast<int>(courses.size()); ++from) {
    Trunk trunk{p, {}, {}, {}};
    for (const Course& course : courses_from(courses, from))
      if (like_coronary(course)) {
        trunk.root = course.spheres.front().p;
        trunk.ends.push_back(course.spheres.back().p);
        trunk.courses.push_back(course);
      }
    if (!trunk.ends.empty() && radius_near_end(trunk.courses[0], true) > 0.5 * widest)
      trunks.push_back(std::move(trunk));
  }
}

}  // namespace

std::vector<Trunk> coronary_trunks(const std::vector<LumenPart>& parts, const AortaMatch* aorta) {
  std::vector<Trunk> trunks;
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (aorta && p == 0)
      add_aortic_trunks(parts[p], *aorta, trunks);
    else if (parts[p].widest_m < coronary_radius_m)
      add_loose_trunks(parts[p], p, trunks);
  return trunks;
}

}  // namespace ostium::vascular
