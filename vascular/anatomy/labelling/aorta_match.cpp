#include "vascular/anatomy/labelling/aorta_match.h"

#include <algorithm>

#include "core/base/units.h"
#include "vascular/anatomy/labelling/recognition.h"
#include "vascular/geometry/centreline/centreline.h"
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"

namespace ostium::vascular {

namespace {

using units::mm;
constexpr double aorta_radius_m = 7e-3;  // lower limit for an aorta
constexpr double unlike_any = 1e9;       // m: no fit is possible
constexpr double least_branch_m = 10 * mm, one_origin_m = 4 * mm;
// A branch of an arch leaves this near to where the mean one's would, at the mean's size, and about as it does: near is
// not nearer, since a fit may lie shifted along a course whose root is cut off somewhere.
constexpr double arch_reach_m = 40 * mm, arch_cosine = 0.5;

/// Distance of a course from the mean aorta, m; `fit` receives the transform of the mean aorta.
double unlike_aorta(const MeanCourses& mean, const Course& course, Similarity& fit) {
  const std::vector<Eigen::Vector3d> theirs = course.points(0, labelling_step_m, 0.3);
  double best = unlike_any;
  // The root may be cut off anywhere.
  for (double from = 0; from < 60 * mm; from += labelling_step_m) {
    std::vector<Eigen::Vector3d> ours = mean.aorta.points(from, labelling_step_m, 0.3), same = theirs;
    const std::size_t n = std::min(ours.size(), same.size());
    if (n < 4) continue;
    ours.resize(n);
    same.resize(n);
    const Similarity found = nearest_similarity(ours, same);
    if (found.scale < 0.6 || found.scale > 1.7 || found.rms_m > best) continue;
    best = found.rms_m;
    fit = found;
  }
  return best;
}

/// If coronary arteries leave the root, the root is not an end of the tree: adds a course that ends where the vessel
/// becomes narrow.
std::vector<Course> with_wide_ends(std::vector<Course> courses) {
  const std::size_t n = courses.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t last = courses[c].spheres.size();
    while (last > 0 && courses[c].spheres[last - 1].radius_m < aorta_radius_m) --last;
    if (last < 2) continue;
    const Eigen::Vector3d end = courses[c].spheres[last - 1].p;
    bool there = false;
    for (const Course& other : courses) there = there || (other.spheres.back().p - end).norm() < 5 * mm;
    if (there) continue;
    Course wide;
    wide.spheres.assign(courses[c].spheres.begin(), courses[c].spheres.begin() + static_cast<long>(last));
    courses.push_back(std::move(wide));
  }
  return courses;
}

/// Extends the course from its last sphere to just before the wall.
Eigen::Vector3d to_the_end(const Course& course, const Mesh& mesh) {
  const TreeSphere& last = course.spheres.back();
  std::size_t before = course.spheres.size() - 1;
  while (before > 0 && last.s_m - course.spheres[before].s_m < 1.5 * last.radius_m) --before;
  const Eigen::Vector3d along = (last.p - course.spheres[before].p).normalized();
  const auto hits = BoundingVolumeHierarchy(mesh).hits(last.p, along, 40 * mm);
  return hits.empty() ? last.p : Eigen::Vector3d(last.p + std::max(0.0, hits[0].distance_m - 2 * mm) * along);
}

/// Largest radius within 30 mm of the end of a course, or of the root (-1).
double widest_at_end(const std::vector<Course>& courses, int from) {
  const Course& course = courses[static_cast<std::size_t>(std::max(from, 0))];
  double widest = 0;
  for (const TreeSphere& sphere : course.spheres)
    if ((from < 0 ? sphere.s_m : course.length_m() - sphere.s_m) < 30 * mm) widest = std::max(widest, sphere.radius_m);
  return widest;
}

/// Among all paths between two ends, the one most like the mean aorta begins at the root; the tree is then recomputed
/// from there.
void begin_at_root(const MeanCourses& mean, const Progress& say, LumenPart& part) {
  struct Candidate {
    double unlike, length;
    int root;
  };
  std::vector<Candidate> found;
  const std::vector<Course> candidates = with_wide_ends(part.courses);
  for (int from = -1; from < static_cast<int>(candidates.size()); ++from) {
    const std::vector<Course> paths = courses_from(candidates, from);
    if (paths.empty() || widest_at_end(candidates, from) < aorta_radius_m) continue;
    double longest = 0;
    for (const Course& path : paths) longest = std::max(longest, path.length_m());
    Similarity fit;
    for (const Course& path : paths)
      if (path.length_m() >= 0.6 * longest) found.push_back({unlike_aorta(mean, path, fit), path.length_m(), from});
  }
  double best = unlike_any, farthest = 0;
  int root = -1;
  for (const Candidate& c : found) best = std::min(best, c.unlike);
  // Among similar ones, the longest, which begins deepest in the root.
  for (const Candidate& c : found)
    if (c.unlike < best + 4 * mm && c.length > farthest) farthest = c.length, root = c.root;
  if (root >= 0) {
    say("looking for centrelines from the aortic root");
    part.root = to_the_end(candidates[static_cast<std::size_t>(root)], part.mesh);
    part.tree = find_centrelines(part.mesh, {.start = part.root, .ends = {}, .to_lids = false}).tree;
    part.courses = courses_of(part.tree);
  }
}

/// Whether the branches of an arch leave a course that `fit` lays the mean aorta along.
bool has_arch(const MeanCourses& mean, const LumenPart& part, const AortaMatch& match) {
  std::vector<Eigen::Vector3d> origins;
  for (const Course& course : part.courses) {
    const Course rest = beyond(course, match.course);
    if (rest.spheres.size() < 2 || rest.length_m() < least_branch_m) continue;
    const Eigen::Vector3d from = rest.spheres.front().p;
    const double first_m = std::min(rest.length_m(), 2 * least_branch_m);
    const Eigen::Vector3d along = (rest.points(0, first_m, first_m).back() - from).normalized();
    const bool like = std::ranges::any_of(mean.arch, [&](const MeanCourses::Leaving& theirs) {
      return (from - match.fit * theirs.p).norm() < arch_reach_m * match.fit.scale &&
             along.dot(match.fit.R * theirs.direction) > arch_cosine;
    });
    const bool there = std::ranges::any_of(
        origins, [&](const Eigen::Vector3d& other) { return (other - from).norm() < one_origin_m; });
    if (like && !there) origins.push_back(from);
  }
  return std::ssize(origins) >= least_arch_branches;
}

}  // namespace

std::optional<AortaMatch> match_aorta(LumenPart& part, const MeanCourses& mean, const Progress& say) {
  if (part.widest_m < aorta_radius_m) return std::nullopt;
  begin_at_root(mean, say, part);
  AortaMatch match;
  double longest = 0;
  for (const Course& course : part.courses) longest = std::max(longest, course.length_m());
  std::size_t chosen = 0;
  std::vector<std::pair<double, Similarity>> compared;
  double best = unlike_any;
  for (const Course& course : part.courses) {
    Similarity fit;
    compared.emplace_back(unlike_aorta(mean, course, fit) + (course.length_m() < 0.6 * longest ? 1 : 0), fit);
    best = std::min(best, compared.back().first);
  }
  // Paths into side branches are similar too, as far as they follow the aorta.
  double farthest = 0;
  for (std::size_t c = 0; c < compared.size(); ++c)
    if (const double length = part.courses[c].length_m(); compared[c].first < best + 4 * mm && length > farthest)
      farthest = length, chosen = c, match.fit = compared[c].second;
  if (farthest == 0 || best >= unlike_any) return std::nullopt;
  match.course = part.courses[chosen];
  match.doubt = aorta_doubt(match.fit, match.course.length_m());
  match.arch = has_arch(mean, part, match);
  return match;
}

}  // namespace ostium::vascular
