#include "tests/support/made_up_vessels.h"

#include <map>
#include <set>
#include <stdexcept>

#include "tests/support/dice.h"
#include "vascular/anatomy/anatomy.h"
#include "vascular/geometry/implicit/contour.h"

namespace ostium::synthetic {

namespace {

using units::mm;
using vascular::Tube;

/// Of a tube, what lies beyond `from_m`.
Tube beyond(const Tube& tube, double from_m) {
  Tube rest = tube;
  rest.nodes.clear();
  for (const vascular::TubeNode& node : tube.nodes)
    if (node.s_m >= from_m) {
      rest.nodes.push_back(node);
      rest.nodes.back().s_m -= from_m;
    }
  return rest;
}

vascular::Anatomy person_of(Dice& dice) {
  const int draw = dice.whole(1, 100);
  const auto dominance = draw > 15  ? vascular::Dominance::right
                         : draw > 7 ? vascular::Dominance::left
                                    : vascular::Dominance::balanced;
  return build_anatomy(person(static_cast<std::uint64_t>(dice.whole(1, 1'000'000)), vascular::mean_of(dominance)));
}

/// The trees of some arteries without the aorta they leave, from `skipped` of their length on.
std::vector<Tube> trees_of(const vascular::Anatomy& anatomy, const std::set<std::string>& roots, double skipped = 0) {
  std::map<int, double> begins;
  for (const std::string& root : roots) {
    const vascular::NamedBranch& branch = *find_branch(anatomy, root);
    const double length = anatomy.tubes[static_cast<std::size_t>(branch.tube)].length_m();
    begins[branch.tube] = branch.from_m + 1 * mm + skipped * length;
  }
  std::vector<Tube> tubes;
  std::map<int, int> index;
  for (int t = 0; t < static_cast<int>(anatomy.tubes.size()); ++t) {
    const Tube& tube = anatomy.tubes[static_cast<std::size_t>(t)];
    if (begins.contains(t)) {
      index[t] = static_cast<int>(tubes.size());
      tubes.push_back(beyond(tube, begins[t]));
      tubes.back().parent = -1;
    } else if (index.contains(tube.parent) && tube.leaves_parent) {
      const Tube& parent = anatomy.tubes[static_cast<std::size_t>(tube.parent)];
      if (begins.contains(tube.parent) && nearest_s(parent, tube.nodes.front().p) < begins[tube.parent] + 2 * mm)
        continue;
      index[t] = static_cast<int>(tubes.size());
      tubes.push_back(tube);
      tubes.back().parent = index[tube.parent];
    }
  }
  return tubes;
}

/// The aorta of a person with its own branches, with or without coronary arteries.
std::vector<Tube> aorta_of(const vascular::Anatomy& anatomy, bool coronaries) {
  std::set<int> left_out;
  std::map<int, int> index = {{-1, -1}};
  std::vector<Tube> tubes;
  if (!coronaries)
    for (const char* root : {"LM", "RCA"}) left_out.insert(find_branch(anatomy, root)->tube);
  for (int t = 0; t < static_cast<int>(anatomy.tubes.size()); ++t) {
    const Tube& tube = anatomy.tubes[static_cast<std::size_t>(t)];
    if (left_out.contains(t) || left_out.contains(tube.parent)) {
      left_out.insert(t);
      continue;
    }
    index[t] = static_cast<int>(tubes.size());
    tubes.push_back(tube);
    tubes.back().parent = index[tube.parent];
  }
  return tubes;
}

struct Stretch {
  double length_mm, from_mm, to_mm;  ///< diameters
  double bend_per_mm = 0;            ///< rad; of the same sign throughout
  double wander = 0.1;               ///< rad at each of its steps
};

/// Vessels that grow, one from another.
class Growth {
 public:
  explicit Growth(Dice& dice) : dice_(dice) {}

  int add(int parent, double share, const Eigen::Vector3d& direction, const Stretch& s) {
    const Eigen::Vector3d from = parent < 0 ? Eigen::Vector3d(dice_.normals() * 20 * mm) : at(parent, share).p;
    Eigen::Vector3d p = from, along = direction.normalized();
    const Eigen::Vector3d axis = along.cross(dice_.direction()).normalized();
    const int steps = std::max(4, static_cast<int>(s.length_mm / 8));
    std::vector<vascular::CoursePoint> course;
    for (int i = 0; i <= steps; ++i) {
      course.push_back({p, (s.from_mm + (s.to_mm - s.from_mm) * i / steps) / 2 * mm});
      along = Eigen::AngleAxisd(s.bend_per_mm * s.length_mm / steps, axis) * along;
      along = (along + s.wander * dice_.normals()).normalized();
      p += s.length_mm / steps * mm * along;
    }
    tubes.push_back(make_tube("", parent, course));
    return static_cast<int>(tubes.size()) - 1;
  }
  vascular::TubeNode at(int tube, double share) const {
    const Tube& t = tubes[static_cast<std::size_t>(tube)];
    return t.at(share * t.length_m());
  }
  Eigen::Vector3d along(int tube, double share) const {
    const Tube& t = tubes[static_cast<std::size_t>(tube)];
    return t.tangent(share * t.length_m());
  }
  /// A branch at an angle to its parent, in a random direction.
  int branch(int parent, double share, double angle, const Stretch& s) {
    const Eigen::Vector3d tangent = along(parent, share);
    const Eigen::Vector3d side = tangent.cross(dice_.direction()).normalized();
    return add(parent, share, std::cos(angle) * tangent + std::sin(angle) * side, s);
  }

  std::vector<Tube> tubes;

 private:
  Dice& dice_;
};

std::vector<Tube> tube(Dice& dice) {
  Growth g(dice);
  const double diameter = dice.log_uniform(1.5, 20);
  g.add(-1, 0, dice.direction(),
        {diameter * dice.uniform(9, 40), diameter, diameter * dice.uniform(0.6, 1), dice.uniform(0, 0.25) / diameter,
         0.02});
  return g.tubes;
}

std::vector<Tube> wandering(Dice& dice) {
  Growth g(dice);
  const int trunk =
      g.add(-1, 0, dice.direction(), {dice.uniform(60, 180), dice.uniform(2.5, 4.5), 2, 0, dice.uniform(0.1, 0.4)});
  for (int i = dice.whole(0, 4); i > 0; --i)
    g.branch(trunk, dice.uniform(0.1, 0.7), dice.uniform(0.4, 1.2), {dice.uniform(30, 90), 2.2, 1.4, 0, 0.2});
  return g.tubes;
}

std::vector<Tube> carotid(Dice& dice) {
  Growth g(dice);
  for (int side = dice.whole(1, 2); side > 0; --side) {
    const Eigen::Vector3d up = (Eigen::Vector3d::UnitZ() + 0.1 * dice.normals()).normalized();
    const int common = g.add(-1, 0, up, {dice.uniform(40, 130), dice.uniform(5.5, 7), 6, 0, 0.05});
    g.branch(common, 0.97, 0.35, {dice.uniform(60, 110), 4.8, 4.2, dice.uniform(0, 0.01), 0.15});
    const int outer = g.branch(common, 0.97, 0.45, {dice.uniform(50, 80), 4, 2.5, 0, 0.15});
    for (double at : {0.3, 0.6}) g.branch(outer, at, 1, {dice.uniform(20, 40), 2, 1.4, 0, 0.2});
  }
  return g.tubes;
}

std::vector<Tube> cerebral(Dice& dice) {
  Growth g(dice);
  for (int side : {-1, 1}) {
    const Eigen::Vector3d out(side, 0, 0.3);
    const int inner =
        g.add(-1, 0, Eigen::Vector3d::UnitZ(), {dice.uniform(25, 60), 4.5, 3.8, dice.uniform(0.01, 0.05), 0.2});
    const int middle = g.add(inner, 1, out + 0.2 * dice.normals(), {dice.uniform(20, 35), 3, 2.6, 0, 0.1});
    g.add(inner, 1, Eigen::Vector3d(-0.3 * side, 1, 0.3), {dice.uniform(40, 90), 2.5, 1.6, 0.015, 0.15});
    for (int k = 0; k < 2; ++k)
      g.branch(middle, 0.97, dice.uniform(0.4, 0.8), {dice.uniform(50, 90), 2.3, 1.4, dice.uniform(0, 0.02), 0.2});
  }
  return g.tubes;
}

std::vector<Tube> renal(Dice& dice) {
  Growth g(dice);
  for (int side : {-1, 1}) {
    if (side > 0 && dice.whole(0, 1)) continue;
    const int trunk = g.add(-1, 0, Eigen::Vector3d(side, 0.3, -0.2),
                            {dice.uniform(35, 60), dice.uniform(4.5, 6.5), 4.5, 0.005, 0.08});
    for (int k = dice.whole(2, 4); k > 0; --k) {
      const int next =
          g.branch(trunk, dice.uniform(0.75, 0.98), dice.uniform(0.3, 0.8), {dice.uniform(20, 40), 3, 2, 0, 0.15});
      g.branch(next, 0.6, 0.6, {dice.uniform(12, 25), 1.8, 1.4, 0, 0.15});
    }
  }
  return g.tubes;
}

std::vector<Tube> iliac(Dice& dice) {
  Growth g(dice);
  const int trunk = g.add(-1, 0, -Eigen::Vector3d::UnitZ(), {dice.uniform(40, 120), dice.uniform(13, 22), 14, 0, 0.03});
  for (int side : {-1, 1}) {
    const int common = g.add(trunk, 0.97, Eigen::Vector3d(0.4 * side, 0, -1), {dice.uniform(40, 70), 10, 9, 0, 0.1});
    g.add(common, 0.97, Eigen::Vector3d(0.3 * side, 0.3, -1), {dice.uniform(60, 120), 8, 7, 0, 0.1});
    g.add(common, 0.97, Eigen::Vector3d(0, -0.6, -1), {dice.uniform(30, 50), 5.5, 4, 0, 0.15});
  }
  return g.tubes;
}

/// As wide as an aorta and bent like an arch: a leg, an arc, another leg.
std::vector<Tube> wide_bent(Dice& dice, int branches) {
  const double radius = dice.uniform(25, 60), arc = dice.uniform(1.8, 3.6), step = 8;
  const double legs[] = {dice.uniform(20, 90), dice.uniform(20, 300)};
  const double from = dice.uniform(16, 32), to = from * dice.uniform(0.6, 1);
  const double length = legs[0] + arc * radius + legs[1];
  Eigen::Vector3d p = Eigen::Vector3d::Zero(), along = Eigen::Vector3d::UnitY();
  const double twist = dice.uniform(-0.3, 0.3);  // of the second leg's plane, rad
  std::vector<vascular::CoursePoint> course;
  for (double s = 0; s <= length; s += step) {
    course.push_back({p, (from + (to - from) * s / length) / 2 * mm});
    if (s > legs[0] && s < legs[0] + arc * radius)
      along = Eigen::AngleAxisd(step / radius, Eigen::Vector3d(std::sin(twist), 0, std::cos(twist))) * along;
    p += step * mm * (along + 0.03 * dice.normals()).normalized();
  }
  Growth g(dice);
  g.tubes.push_back(make_tube("", -1, course));
  for (int i = 0; i < branches; ++i)
    g.branch(0, dice.uniform(0.1, 0.9), dice.uniform(0.6, 1.4),
             {dice.uniform(30, 90), dice.uniform(4, 11), dice.uniform(3, 9), 0, 0.1});
  return g.tubes;
}

MadeUpVessels straight(const std::string& kind, Dice& dice) {
  if (kind == "coronary arteries") return {trees_of(person_of(dice), {"LM", "RCA"}), true, false};
  if (kind == "left coronary artery") return {trees_of(person_of(dice), {"LM"}), true, false};
  if (kind == "aorta and coronary arteries") return {aorta_of(person_of(dice), true), true, true};
  if (kind == "aorta") return {aorta_of(person_of(dice), false), false, true};
  if (kind == "right coronary artery") return {trees_of(person_of(dice), {"RCA"}), false, false};
  if (kind == "distal coronary arteries") return {trees_of(person_of(dice), {"LM", "RCA"}, 0.45), false, false};
  if (kind == "mirrored coronary arteries") {
    MadeUpVessels made{trees_of(person_of(dice), {"LM", "RCA"}), false, false};
    for (Tube& t : made.tubes)
      for (vascular::TubeNode& node : t.nodes) node.p.x() *= -1;
    return made;
  }
  if (kind == "tube") return {tube(dice), false, false};
  if (kind == "wide bent tube") return {wide_bent(dice, 0), false, false};
  if (kind == "wide bent vessel") return {wide_bent(dice, dice.whole(1, 4)), false, false};
  if (kind == "wandering vessel") return {wandering(dice), false, false};
  if (kind == "carotid arteries") return {carotid(dice), false, false};
  if (kind == "cerebral arteries") return {cerebral(dice), false, false};
  if (kind == "renal arteries") return {renal(dice), false, false};
  if (kind == "iliac arteries") return {iliac(dice), false, false};
  throw std::invalid_argument("there are no made-up vessels \"" + kind + "\"");
}

}  // namespace

const std::vector<std::string>& made_up_kinds() {
  static const std::vector<std::string> kinds = {"coronary arteries",
                                                 "left coronary artery",
                                                 "aorta and coronary arteries",
                                                 "aorta",
                                                 "right coronary artery",
                                                 "distal coronary arteries",
                                                 "mirrored coronary arteries",
                                                 "tube",
                                                 "wide bent tube",
                                                 "wide bent vessel",
                                                 "wandering vessel",
                                                 "carotid arteries",
                                                 "cerebral arteries",
                                                 "renal arteries",
                                                 "iliac arteries"};
  return kinds;
}

MadeUpVessels made_up_vessels(const std::string& kind, unsigned seed) {
  Dice dice(kind, seed);
  MadeUpVessels made = straight(kind, dice);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(dice.uniform(0, units::pi), dice.direction()).toRotationMatrix();
  for (Tube& t : made.tubes)
    for (vascular::TubeNode& node : t.nodes) node.p = turn * node.p;
  return made;
}

vascular::Mesh mesh_of(const MadeUpVessels& vessels) {
  return contour(vascular::TubeUnion(vessels.tubes),
                 {.cell_at_1_mm_m = 0.8 * mm, .finest_m = 0.5 * mm, .relaxations = 1})
      .mesh;
}

}  // namespace ostium::synthetic
