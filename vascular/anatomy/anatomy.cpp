#include "vascular/anatomy/anatomy.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "vascular/anatomy/builder.h"

namespace ostium::vascular {

namespace {

/// Arc length at which the tube's centreline leaves the lumen of the tubes before it.
double leaves_at(const std::vector<Tube>& tubes, int t) {
  const std::vector<Tube> before(tubes.begin(), tubes.begin() + t);
  if (before.empty()) return 0;
  const TubeUnion others(before);
  for (const TubeNode& node : tubes[t].nodes) {
    double least = 1;
    for (int s = 0; s < static_cast<int>(others.segments().size()); ++s)
      least = std::min(least, others.distance(s, node.p));
    if (least > 0) return node.s_m;
  }
  return tubes[t].length_m();
}

/// Whether arteries from tube `first` on touch others elsewhere than at their origin: touching walls would move through
/// each other during the cardiac cycle.
bool arteries_touch(const std::vector<Tube>& tubes, int first) {
  constexpr double gap_m = 0.6e-3, junction_m = 8e-3;
  for (int a = first; a < static_cast<int>(tubes.size()); ++a)
    for (int b = first; b < a; ++b)
      for (const TubeNode& p : tubes[a].nodes)
        for (const TubeNode& q : tubes[b].nodes)
          if ((p.p - q.p).squaredNorm() < std::pow(p.radius_m + q.radius_m + gap_m, 2) && p.s_m > junction_m &&
              (tubes[a].parent == b || q.s_m > junction_m))
            return true;
  return false;
}

void check(const AnatomyParameters& p) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("anatomy: ") + what);
  };
  require(p.diagonals >= 1 && p.diagonals <= 3, "diagonals outside 1 to 3");
  require(p.heart_scale >= 0.8 && p.heart_scale <= 1.2, "heart_scale outside 0.8 to 1.2");
  require(p.heart_turn_rad.cwiseAbs().maxCoeff() <= 0.35, "heart_turn_rad beyond 0.35");
  require(p.course_wander_m >= 0 && p.course_wander_m <= 3e-3, "course_wander_m outside 0 to 3 mm");
  require(p.side_branch_scale >= 0.6 && p.side_branch_scale <= 1.4, "side_branch_scale outside 0.6 to 1.4");
  for (double mm : {p.left_main_mm, p.lad_proximal_mm, p.lcx_proximal_mm, p.rca_proximal_mm})
    require(mm >= 1.5 && mm <= 7, "a coronary diameter outside 1.5 to 7 mm");
  require(p.lad_distal_mm >= 1 && p.lad_distal_mm <= p.lad_proximal_mm, "lad_distal_mm outside 1 to lad_proximal_mm");
  for (double mm : {p.sinus_mm, p.ascending_mm, p.arch_mm, p.isthmus_mm, p.diaphragm_mm})
    require(mm >= 15 && mm <= 45, "an aortic diameter outside 15 to 45 mm");
  for (double mm : {p.infrarenal_mm, p.common_iliac_mm, p.external_iliac_mm, p.femoral_mm})
    require(mm >= 4 && mm <= 30, "an iliac or femoral diameter outside 4 to 30 mm");
  require(p.arch_height_mm >= 25 && p.arch_height_mm <= 80, "arch_height_mm outside 25 to 80");
  require(p.arch_width_mm >= 50 && p.arch_width_mm <= 120, "arch_width_mm outside 50 to 120");
}

}  // namespace

int AnatomyBuilder::add(const std::string& name, int parent, std::vector<CoursePoint> course, double blend) {
  if (parent >= 0) {
    const Tube& from = anatomy_.tubes[parent];
    course.front().p = from.at(nearest_s(from, course.front().p)).p;
  }
  Tube tube = make_tube(name, parent, course);
  tube.blend = blend;
  anatomy_.tubes.push_back(std::move(tube));
  const int t = static_cast<int>(anatomy_.tubes.size()) - 1;
  anatomy_.branches.push_back({name, t, leaves_at(anatomy_.tubes, t), anatomy_.tubes[t].length_m()});
  return t;
}

void AnatomyBuilder::name_trunk(const std::string& trunk, const Eigen::Vector3d& trunk_end) {
  NamedBranch& last = anatomy_.branches.back();
  const double end = nearest_s(anatomy_.tubes[last.tube], trunk_end);
  const NamedBranch first{trunk, last.tube, last.from_m, end};
  last.from_m = end;
  anatomy_.branches.insert(anatomy_.branches.end() - 1, first);
}

int AnatomyBuilder::tube(const std::string& branch) const {
  const NamedBranch* found = find_branch(anatomy_, branch);
  assert(found);
  return found->tube;
}

namespace {
Anatomy build_once(const AnatomyParameters& parameters);
}

Anatomy build_anatomy(const AnatomyParameters& parameters) {
  check(parameters);
  Anatomy anatomy = build_once(parameters);
  AnatomyParameters calmer = parameters;
  for (int i = 0; i < 5 && arteries_touch(anatomy.tubes, find_branch(anatomy, "LM")->tube); ++i) {
    calmer.course_wander_m = i < 4 ? calmer.course_wander_m / 2 : 0;
    anatomy = build_once(calmer);
  }
  return anatomy;
}

namespace {
Anatomy build_once(const AnatomyParameters& parameters) {
  Anatomy anatomy;
  const Root root = make_root(parameters);
  Landmarks& marks = anatomy.landmarks;
  AnatomyBuilder builder(anatomy);
  add_aorta(builder, root, parameters, marks);
  add_coronaries(builder, root, parameters);
  const Tube& entry = anatomy.tubes[parameters.access == Access::femoral ? 0 : builder.tube("right arm")];
  const double entry_s = nearest_s(entry, marks.p_access);
  marks.p_access = entry.at(entry_s).p;
  marks.access_direction = -entry.tangent(entry_s);
  marks.p_left_ostium = root.p_left_ostium;
  marks.p_right_ostium = root.p_right_ostium;
  marks.p_annulus = root.p_annulus;
  marks.root_axis = root.axis;
  // The ellipsoid of revolution through Dodge's 15 points on the left ventricle (rms 2.3 mm): centre (12.0, -46.1,
  // 19.6), axis (0.678, -0.427, 0.599); the points of the AV groove lie 18 to 31 mm before its centre, the end of the
  // LAD 71 mm behind it.
  const Eigen::Vector3d middle_mm(12.0, -46.1, 19.6), axis(0.678, -0.427, 0.599);
  marks.p_lv_base = root.from_left(middle_mm - 22 * axis);
  marks.p_lv_apex = root.from_left(middle_mm + 73 * axis);
  const Eigen::Vector3d along = (marks.p_lv_apex - marks.p_lv_base).normalized();
  const Eigen::Vector3d groove = root.from_right({-29.3, -34.2, 9.5}) - marks.p_lv_base;
  marks.right_groove = (groove - groove.dot(along) * along).normalized();
  return anatomy;
}
}  // namespace

const NamedBranch* find_branch(const Anatomy& anatomy, const std::string& name) {
  for (const NamedBranch& branch : anatomy.branches)
    if (branch.name == name) return &branch;
  return nullptr;
}

}  // namespace ostium::vascular
