#include "vascular/anatomy/editing/edit_anatomy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "core/base/units.h"
#include "vascular/anatomy/labelling/landmarks.h"
#include "vascular/geometry/centreline/centreline.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

namespace {

using units::mm;

constexpr double shortest_m = 3e-3;       // of a vessel, and of a stretch with a name
constexpr double added_margin_m = 15e-3;  // beside the way to a vessel that is added
constexpr double voxel_m = 0.25e-3;       // for the way there; spheres are fitted to the wall itself
constexpr double added_blend = 1.6;       // in radii, as of imported branches
constexpr double most_apart = 0.6;        // of neighbours, in radii

const Tube& tube_of(const Anatomy& anatomy, int tube) {
  if (tube < 0 || tube >= static_cast<int>(anatomy.tubes.size()))
    throw std::invalid_argument(fmt::format("there is no vessel {}; expected 0 to {}", tube, anatomy.tubes.size() - 1));
  return anatomy.tubes[static_cast<std::size_t>(tube)];
}

/// What a person calls a tube: its first branch's name.
std::string called(const Anatomy& anatomy, int tube) {
  for (const NamedBranch& branch : anatomy.branches)
    if (branch.tube == tube) return branch.name;
  return fmt::format("vessel {}", tube);
}

void measure_along(std::vector<TubeNode>& nodes) {
  nodes.front().s_m = 0;
  for (std::size_t i = 1; i < nodes.size(); ++i) nodes[i].s_m = nodes[i - 1].s_m + (nodes[i].p - nodes[i - 1].p).norm();
}

/// Neighbours overlap; none lie on one another.
std::vector<TubeNode> evened(const std::vector<TubeNode>& nodes) {
  std::vector<TubeNode> out = {nodes.front()};
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const TubeNode a = out.back(), b = nodes[i];
    const double apart_m = (b.p - a.p).norm();
    if (apart_m < 1e-6) continue;
    const int parts =
        std::max(1, static_cast<int>(std::ceil(apart_m / (most_apart * std::min(a.radius_m, b.radius_m)))));
    for (int k = 1; k <= parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      out.push_back({a.p + t * (b.p - a.p), a.radius_m + t * (b.radius_m - a.radius_m), 0});
    }
  }
  return out;
}

/// Another course, with the tube's names where they were in space.
void set_course(Anatomy& anatomy, int t, const std::vector<TubeNode>& nodes) {
  Tube& tube = anatomy.tubes[static_cast<std::size_t>(t)];
  const Tube before = tube;
  tube.nodes = evened(nodes);
  if (tube.nodes.size() < 2) throw std::invalid_argument("all spheres would lie in one point; expected a course");
  measure_along(tube.nodes);
  for (NamedBranch& branch : anatomy.branches) {
    if (branch.tube != t) continue;
    const auto moved = [&](double s_m) {
      if (s_m <= 0) return 0.0;
      if (s_m >= before.length_m() - 1e-9) return tube.length_m();
      return nearest_s(tube, before.at(s_m).p);
    };
    branch.from_m = moved(branch.from_m), branch.to_m = std::max(branch.from_m, moved(branch.to_m));
  }
}

void fit_radius(TubeNode& node, const LumenGauge& lumen) {
  if (const double clearance_m = lumen.clearance_m(node.p); clearance_m > 0) node.radius_m = clearance_m;
}

bool is_below(const Anatomy& anatomy, int tube, int ancestor) {
  for (; tube >= 0; tube = anatomy.tubes[static_cast<std::size_t>(tube)].parent)
    if (tube == ancestor) return true;
  return false;
}

/// Parents first, as readers want it; branches and the aorta, which stays the first, follow.
void sort_tubes(Anatomy& anatomy) {
  const auto depth = [&](int t) {
    int n = 0;
    for (int up = anatomy.tubes[static_cast<std::size_t>(t)].parent; up >= 0;
         up = anatomy.tubes[static_cast<std::size_t>(up)].parent)
      ++n;
    return n;
  };
  std::vector<int> order(anatomy.tubes.size()), place(anatomy.tubes.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, depth);
  std::vector<Tube> tubes;
  for (std::size_t i = 0; i < order.size(); ++i) place[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  for (const int t : order) {
    tubes.push_back(anatomy.tubes[static_cast<std::size_t>(t)]);
    if (int& parent = tubes.back().parent; parent >= 0) parent = place[static_cast<std::size_t>(parent)];
  }
  anatomy.tubes = std::move(tubes);
  for (NamedBranch& branch : anatomy.branches) branch.tube = place[static_cast<std::size_t>(branch.tube)];
}

/// Arc length at which a tube has left its parent's wall.
double leaves_m(const Tube& tube, const Tube& parent) {
  for (const TubeNode& node : tube.nodes) {
    const TubeNode at = parent.at(nearest_s(parent, node.p));
    if ((at.p - node.p).norm() > at.radius_m) return node.s_m;
  }
  return tube.length_m();
}

bool is_kept(const std::string& name) {
  const auto kept = {"aorta", "LM", "LAD", "LCx", "RCA"};
  return std::ranges::any_of(kept, [&](const char* one) { return name == one; });
}

void require_new_name(const Anatomy& anatomy, const std::string& name) {
  if (!is_branch_name(name))
    throw std::invalid_argument(
        fmt::format("\"{}\" is no name; expected at most 40 letters, digits, spaces, - and _", name.substr(0, 60)));
  if (is_kept(name))
    throw std::invalid_argument(fmt::format(
        "{} is a name by which the heart or the aorta is known; expected another, or an import with --rename", name));
  if (find_branch(anatomy, name))
    throw std::invalid_argument(fmt::format("there is a branch {} already; expected another name", name));
}

NamedBranch& branch_called(Anatomy& anatomy, const std::string& name) {
  for (NamedBranch& branch : anatomy.branches)
    if (branch.name == name) return branch;
  throw std::invalid_argument(fmt::format("there is no branch {}; expected a name of the list", name.substr(0, 60)));
}

struct NearestTube {
  int tube = 0;
  double s_m = 0, to_wall_m = 0;
};
NearestTube nearest_tube(const Anatomy& anatomy, const Eigen::Vector3d& p) {
  NearestTube best{0, 0, 1e9};
  for (int t = 0; t < static_cast<int>(anatomy.tubes.size()); ++t) {
    const Tube& tube = anatomy.tubes[static_cast<std::size_t>(t)];
    const double s_m = nearest_s(tube, p), d = (tube.at(s_m).p - p).norm() - tube.at(s_m).radius_m;
    if (tube.leaves_parent && d < best.to_wall_m) best = {t, s_m, d};
  }
  return best;
}

/// Triangles of all columns along z that a box touches: inside and outside are told along these.
Mesh columns_of(const Mesh& wall, const Eigen::AlignedBox3d& box) {
  Mesh out{wall.vertices, {}};
  for (const auto& t : wall.triangles) {
    Eigen::AlignedBox3d own;
    for (const int v : t) own.extend(wall.vertices[static_cast<std::size_t>(v)]);
    if (own.min().x() <= box.max().x() && own.max().x() >= box.min().x() && own.min().y() <= box.max().y() &&
        own.max().y() >= box.min().y())
      out.triangles.push_back(t);
  }
  return out;
}

}  // namespace

Anatomy with_moved_node(Anatomy anatomy, const LumenGauge& lumen, int t, std::size_t node, const Eigen::Vector3d& p,
                        double reach_m) {
  const Tube& tube = tube_of(anatomy, t);
  if (node >= tube.nodes.size())
    throw std::invalid_argument(
        fmt::format("{} has no sphere {}; expected 0 to {}", called(anatomy, t), node, tube.nodes.size() - 1));
  if (!p.allFinite() || !(reach_m >= 0 && reach_m <= 0.2))
    throw std::invalid_argument("a sphere goes nowhere; expected a place, and a reach of 0 to 200 mm");
  std::vector<TubeNode> nodes = tube.nodes;
  const Eigen::Vector3d by = p - nodes[node].p;
  for (TubeNode& one : nodes) {
    const double away_m = std::abs(one.s_m - tube.nodes[node].s_m);
    if (&one != &nodes[node] && away_m >= reach_m) continue;
    const double share = away_m > 0 ? (1 + std::cos(M_PI * away_m / reach_m)) / 2 : 1;
    one.p += share * by;
    fit_radius(one, lumen);
  }
  set_course(anatomy, t, nodes);
  return anatomy;
}

Anatomy with_centred_course(Anatomy anatomy, const LumenGauge& lumen, int t, double from_m, double to_m) {
  const Tube& tube = tube_of(anatomy, t);
  if (!(from_m <= to_m) || to_m < 0 || from_m > tube.length_m())
    throw std::invalid_argument(
        fmt::format("there is no stretch from {:.1f} to {:.1f} mm; expected one within 0 to "
                    "{:.1f} mm",
                    from_m / mm, to_m / mm, tube.length_m() / mm));
  std::vector<TubeNode> nodes = tube.nodes;
  for (TubeNode& node : nodes)
    if (node.s_m >= from_m && node.s_m <= to_m) {
      node.p = lumen.centred(node.p, tube.tangent(node.s_m));
      fit_radius(node, lumen);
    }
  set_course(anatomy, t, nodes);
  return anatomy;
}

Anatomy with_end(Anatomy anatomy, int t, double s_m) {
  tube_of(anatomy, t);
  Tube& tube = anatomy.tubes[static_cast<std::size_t>(t)];
  const std::string name = called(anatomy, t);
  if (!(s_m >= shortest_m && s_m < tube.length_m()))
    throw std::invalid_argument(fmt::format("{} cannot end at {:.1f} mm; expected {:.0f} to {:.1f}", name, s_m / mm,
                                            shortest_m / mm, tube.length_m() / mm));
  for (int child = 0; child < static_cast<int>(anatomy.tubes.size()); ++child) {
    const Tube& other = anatomy.tubes[static_cast<std::size_t>(child)];
    if (other.parent == t && nearest_s(tube, other.nodes.front().p) > s_m)
      throw std::invalid_argument(
          fmt::format("{} leaves {} farther on; remove it first", called(anatomy, child), name));
  }
  for (NamedBranch& branch : anatomy.branches) {
    if (branch.tube != t) continue;
    branch.to_m = std::min(branch.to_m, s_m);
    if (branch.to_m - branch.from_m < std::min(shortest_m, branch.length_m()) || branch.from_m >= s_m)
      throw std::invalid_argument(fmt::format("nothing would be left of {}; expected an end farther on", branch.name));
  }
  const TubeNode last = tube.at(s_m);
  std::erase_if(tube.nodes, [&](const TubeNode& node) { return node.s_m > s_m - 1e-6; });
  tube.nodes.push_back(last);
  return anatomy;
}

Anatomy without_tube(Anatomy anatomy, int t) {
  tube_of(anatomy, t);
  const std::string name = called(anatomy, t);
  if (anatomy.tubes.size() == 1) throw std::invalid_argument(name + " is the only vessel, and stays");
  if (anatomy.aorta && t == 0) throw std::invalid_argument(name + " stays: everything else is placed by the aorta");
  for (int child = 0; child < static_cast<int>(anatomy.tubes.size()); ++child)
    if (anatomy.tubes[static_cast<std::size_t>(child)].parent == t)
      throw std::invalid_argument(
          fmt::format("{} leaves {}; remove it first, or join it to another", called(anatomy, child), name));
  anatomy.tubes.erase(anatomy.tubes.begin() + t);
  for (Tube& tube : anatomy.tubes) tube.parent -= tube.parent > t;
  std::erase_if(anatomy.branches, [&](const NamedBranch& branch) { return branch.tube == t; });
  for (NamedBranch& branch : anatomy.branches) branch.tube -= branch.tube > t;
  return anatomy;
}

Anatomy with_joined_tube(Anatomy anatomy, const LumenGauge& lumen, int t, int parent) {
  tube_of(anatomy, t), tube_of(anatomy, parent);
  if (anatomy.aorta && t == 0) throw std::invalid_argument("the aorta leaves no other vessel");
  if (is_below(anatomy, parent, t))
    throw std::invalid_argument(fmt::format("{} is a branch of {} itself, or the same; expected another vessel",
                                            called(anatomy, parent), called(anatomy, t)));
  Tube& tube = anatomy.tubes[static_cast<std::size_t>(t)];
  if (tube.parent == parent)
    throw std::invalid_argument(fmt::format("{} leaves {} already", called(anatomy, t), called(anatomy, parent)));
  const Tube& to = anatomy.tubes[static_cast<std::size_t>(parent)];
  // The end that is nearer begins; what led to the former parent is left.
  std::vector<TubeNode> nodes = tube.nodes;
  const auto away_m = [&](const TubeNode& node) { return (to.at(nearest_s(to, node.p)).p - node.p).norm(); };
  const bool turned = tube.parent < 0 && away_m(nodes.back()) < away_m(nodes.front());
  if (turned) {
    for (const Tube& other : anatomy.tubes)
      if (other.parent == t)
        throw std::invalid_argument(fmt::format(
            "the far end of {} is nearer, and branches leave it; join at its beginning", called(anatomy, t)));
    std::ranges::reverse(nodes);
    for (NamedBranch& branch : anatomy.branches)
      if (branch.tube == t)
        branch.from_m = tube.length_m() - branch.to_m, branch.to_m = branch.from_m + branch.length_m();
  }
  const TubeNode origin = to.at(nearest_s(to, nodes.front().p));
  if (TubeNode first{origin.p, nodes.front().radius_m, 0}; (first.p - nodes.front().p).norm() > 1e-6) {
    fit_radius(first, lumen);
    first.radius_m = std::min(first.radius_m, nodes.front().radius_m);
    nodes.insert(nodes.begin(), first);
  }
  if (turned) {
    measure_along(nodes);
    tube.nodes = nodes;
  }
  set_course(anatomy, t, nodes);
  tube.parent = parent, tube.blend = added_blend;
  for (NamedBranch& branch : anatomy.branches)
    if (branch.tube == t && branch.from_m < leaves_m(tube, to))
      branch.from_m = std::min(leaves_m(tube, to), branch.to_m);
  sort_tubes(anatomy);
  return anatomy;
}

Anatomy with_vessel(Anatomy anatomy, const Mesh& wall, const Eigen::Vector3d& p_end, const std::string& name) {
  require_new_name(anatomy, name);
  if (!p_end.allFinite()) throw std::invalid_argument("the vessel ends nowhere; expected a point");
  const NearestTube from = nearest_tube(anatomy, p_end);
  const Tube& parent = anatomy.tubes[static_cast<std::size_t>(from.tube)];
  if (from.to_wall_m < shortest_m)
    throw std::invalid_argument(
        fmt::format("that is on {} or hardly beside it; expected a point at least {:.0f} mm off",
                    called(anatomy, from.tube), shortest_m / mm));
  Eigen::AlignedBox3d box(p_end);
  box.extend(parent.at(from.s_m).p);
  box.min().array() -= added_margin_m, box.max().array() += added_margin_m;
  const Mesh columns = columns_of(wall, box);
  Eigen::AlignedBox3d all;
  for (const auto& t : columns.triangles)
    for (const int v : t) all.extend(columns.vertices[static_cast<std::size_t>(v)]);
  CentrelineOptions options{.start = parent.at(from.s_m).p, .ends = {p_end}};
  options.most_voxels = std::min(options.most_voxels, static_cast<std::size_t>(all.volume() / std::pow(voxel_m, 3)));
  const CentrelineResult way = find_centrelines(columns, options);
  const std::vector<TreeSphere>& spheres = way.tree.branches.at(0).spheres;
  std::vector<CoursePoint> course;
  for (const TreeSphere& sphere : spheres) {
    const TubeNode at = parent.at(nearest_s(parent, sphere.p));
    const bool inside = (at.p - sphere.p).norm() < at.radius_m;
    if (inside) course.clear();  // the last that is still in the parent begins it
    if (course.empty() || (sphere.p - course.back().p).norm() > 0.3 * sphere.radius_m)
      course.push_back({sphere.p, sphere.radius_m});
  }
  if (course.size() > 1) course.front().radius_m = std::min(course.front().radius_m, course[1].radius_m);
  if (course.size() < 3)
    throw std::invalid_argument("the way there does not leave the vessel; expected a point beyond");
  Tube tube = make_tube(name, from.tube, course);
  tube.blend = added_blend;
  const double leaves = leaves_m(tube, parent);
  if (tube.length_m() - leaves < shortest_m)
    throw std::invalid_argument(fmt::format("it would be {:.1f} mm long; expected {:.0f} at least",
                                            (tube.length_m() - leaves) / mm, shortest_m / mm));
  anatomy.branches.push_back({name, static_cast<int>(anatomy.tubes.size()), leaves, tube.length_m()});
  anatomy.tubes.push_back(std::move(tube));
  return anatomy;
}

bool is_branch_name(const std::string& name) {
  const auto fits = [](char c) {
    const auto byte = static_cast<unsigned char>(c);  // of any alphabet
    return byte >= 0x80 || std::isalnum(byte) || c == ' ' || c == '-' || c == '_';
  };
  return !name.empty() && name.size() <= 40 && std::ranges::all_of(name, fits);
}

Anatomy with_name(Anatomy anatomy, const std::string& branch, const std::string& name) {
  NamedBranch& found = branch_called(anatomy, branch);
  if (branch == name) return anatomy;
  if (is_kept(branch))
    throw std::invalid_argument(fmt::format(
        "{} keeps its name, by which the heart or the aorta is known; to exchange arteries import once more with "
        "--rename",
        branch));
  require_new_name(anatomy, name);
  found.name = name;
  return anatomy;
}

Anatomy with_split_branch(Anatomy anatomy, const std::string& branch, double along_m, const std::string& name) {
  require_new_name(anatomy, name);
  NamedBranch& found = branch_called(anatomy, branch);
  if (!(along_m >= shortest_m && found.length_m() - along_m >= shortest_m))
    throw std::invalid_argument(fmt::format("{} cannot be divided at {:.1f} mm; expected {:.0f} to {:.1f}", branch,
                                            along_m / mm, shortest_m / mm, (found.length_m() - shortest_m) / mm));
  const NamedBranch rest{name, found.tube, found.from_m + along_m, found.to_m};
  found.to_m = rest.from_m;
  anatomy.branches.push_back(rest);
  return anatomy;
}

Anatomy with_entry(Anatomy anatomy, const Eigen::Vector3d& p) {
  if (!p.allFinite()) throw std::invalid_argument("the entry is nowhere; expected a point");
  std::vector<std::string> notes;
  set_access(p, anatomy, notes);
  if (!notes.empty()) throw std::invalid_argument(notes.front());
  return anatomy;
}

}  // namespace ostium::vascular
