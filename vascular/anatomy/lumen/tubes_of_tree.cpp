#include "vascular/anatomy/lumen/tubes_of_tree.h"

#include <algorithm>

#include "core/base/units.h"

namespace ostium::vascular {

namespace {

using units::mm;
constexpr double branch_blend = 1.6;  // in radii: distance over which a branch takes over from its parent's motion

/// Trims a branch to start just inside its parent's wall; false if it never leaves it.
bool trimmed(const TreeBranch& branch, const Tube* parent, Tube& tube, double& leaves_m) {
  const std::vector<TreeSphere>& s = branch.spheres;
  std::size_t begin = 0, exit = 0;
  if (parent) {
    const auto depth = [&](std::size_t i) {
      const TubeNode at = parent->at(nearest_s(*parent, s[i].p));
      return (s[i].p - at.p).norm() / at.radius_m;
    };
    while (exit < s.size() && depth(exit) < 1) ++exit;
    if (exit + 2 >= s.size() || s.back().s_m - s[exit].s_m < 3 * mm) return false;
    while (begin < exit && depth(begin) < 0.55) ++begin;
    if (begin == exit && begin > 0) --begin;
  } else {
    // A root extends up to the wall, where spheres shrink.
    std::vector<double> radii;
    for (std::size_t i = 0; i < std::min<std::size_t>(12, s.size()); ++i) radii.push_back(s[i].radius_m);
    std::nth_element(radii.begin(), radii.begin() + static_cast<long>(radii.size() / 2), radii.end());
    while (begin + 4 < s.size() && s[begin].radius_m < 0.75 * radii[radii.size() / 2]) ++begin;
    exit = begin;
  }
  std::vector<double> own;
  for (std::size_t i = exit; i < std::min(exit + 7, s.size()); ++i) own.push_back(s[i].radius_m);
  std::nth_element(own.begin(), own.begin() + static_cast<long>(own.size() / 2), own.end());
  std::vector<CoursePoint> course;
  for (std::size_t i = begin; i < s.size(); ++i) {
    if (!course.empty() && (s[i].p - course.back().p).norm() < 0.3 * s[i].radius_m && i + 1 < s.size()) continue;
    if (!course.empty() && (s[i].p - course.back().p).norm() < 1e-6) continue;
    course.push_back({s[i].p, i < exit ? std::min(s[i].radius_m, own[own.size() / 2]) : s[i].radius_m});
  }
  if (course.size() < 2) return false;
  tube = make_tube("", -1, course);
  leaves_m = nearest_s(tube, s[exit].p);
  return true;
}

}  // namespace

void add_tubes(const LumenPart& part, std::vector<Tube>& tubes, std::vector<double>& leaves) {
  std::vector<int> tube_of;
  std::vector<Eigen::Vector3d> ends;
  const std::size_t first = tubes.size();
  for (const TreeBranch& branch : part.tree.branches) {
    const int parent = branch.parent < 0 ? -1 : tube_of[static_cast<std::size_t>(branch.parent)];
    Tube tube;
    double leaves_m = 0;
    if (!trimmed(branch, parent < 0 ? nullptr : &tubes[static_cast<std::size_t>(parent)], tube, leaves_m)) {
      tube_of.push_back(parent < 0 ? 0 : parent);
      continue;
    }
    tube.parent = parent;
    tube.blend = branch_blend;
    tube_of.push_back(static_cast<int>(tubes.size()));
    ends.push_back(branch.spheres.back().p);
    leaves.push_back(leaves_m);
    tubes.push_back(std::move(tube));
  }
  for (const LumenPart::Role& role : part.roles) {
    const auto nearest = std::min_element(ends.begin(), ends.end(), [&](const auto& a, const auto& b) {
      return (a - role.end).squaredNorm() < (b - role.end).squaredNorm();
    });
    if (nearest != ends.end()) tubes[first + static_cast<std::size_t>(nearest - ends.begin())].name = role.name;
  }
}

}  // namespace ostium::vascular
