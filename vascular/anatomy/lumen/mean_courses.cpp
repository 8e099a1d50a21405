#include "vascular/anatomy/lumen/mean_courses.h"

namespace ostium::vascular {

namespace {

Course part_of(const Tube& tube, double from_m, double to_m) {
  Course course;
  for (const TubeNode& node : tube.nodes)
    if (node.s_m >= from_m && node.s_m <= to_m) course.spheres.push_back({node.p, node.radius_m, node.s_m - from_m});
  return course;
}

}  // namespace

MeanCourses mean_courses() {
  MeanCourses mean{.anatomy = build_anatomy({}), .aorta = {}, .lad = {}, .lcx = {}, .rca = {}};
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
  return mean;
}

}  // namespace ostium::vascular
