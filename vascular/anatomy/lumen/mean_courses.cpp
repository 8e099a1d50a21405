#include "vascular/anatomy/lumen/mean_courses.h"

#include "core/base/units.h"

namespace ostium::vascular {

namespace {

using units::mm;

Course part_of(const Tube& tube, double from_m, double to_m) {
  Course course;
  for (const TubeNode& node : tube.nodes)
    if (node.s_m >= from_m && node.s_m <= to_m) course.spheres.push_back({node.p, node.radius_m, node.s_m - from_m});
  return course;
}

/// Of a tube that leaves the aorta.
MeanCourses::Leaving leaving(const Tube& tube, const Course& aorta) {
  const Course rest = beyond(part_of(tube, 0, tube.length_m()), aorta);
  const std::vector<Eigen::Vector3d> ends = rest.points(0, 20 * mm, 20 * mm);
  return {ends.front(), (ends.back() - ends.front()).normalized()};
}

}  // namespace

MeanCourses mean_courses() {
  MeanCourses mean{.anatomy = build_anatomy({}), .aorta = {}, .lad = {}, .lcx = {}, .rca = {}, .arch = {}};
  const Anatomy& a = mean.anatomy;
  mean.aorta = part_of(a.tubes[0], 0, a.tubes[0].length_m());
  const NamedBranch &lm = *find_branch(a, "LM"), &lcx = *find_branch(a, "LCx"), &rca = *find_branch(a, "RCA");
  const Tube &left = a.tubes[lm.tube], &circumflex = a.tubes[lcx.tube];
  mean.lad = part_of(left, lm.from_m, left.length_m());
  mean.rca = part_of(a.tubes[rca.tube], rca.from_m, a.tubes[rca.tube].length_m());
  mean.lcx = part_of(left, lm.from_m, nearest_s(left, circumflex.nodes.front().p));
  for (const TreeSphere& sphere : part_of(circumflex, 0, circumflex.length_m()).spheres) {
    const TreeSphere& last = mean.lcx.spheres.back();
    const double step = (sphere.p - last.p).norm();
    if (step > 0) mean.lcx.spheres.push_back({sphere.p, sphere.radius_m, last.s_m + step});
  }
  for (const Tube& tube : a.tubes)
    if (tube.name == "right subclavian" || tube.name == "left carotid" || tube.name == "left subclavian")
      mean.arch.push_back(leaving(tube, mean.aorta));
  return mean;
}

}  // namespace ostium::vascular
