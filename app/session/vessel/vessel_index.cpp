#include "app/session/vessel/vessel_index.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "data/formats/decimal.h"

namespace ostium::app {

using Eigen::Vector3d;

namespace {

constexpr double beside_mouth_m = 10e-3, narrowed = 0.8;

/// The parent's radius where a branch leaves it, as it would be without a narrowing there, which moves no mouth.
double radius_at_mouth(const vascular::TreeBranch& parent, int at) {
  const vascular::TreeSphere& there = parent.spheres[static_cast<std::size_t>(at)];
  double widest_m = 0;
  for (const vascular::TreeSphere& sphere : parent.spheres)
    if ((sphere.p - there.p).norm() < beside_mouth_m) widest_m = std::max(widest_m, sphere.radius_m);
  return there.radius_m < narrowed * widest_m ? widest_m : there.radius_m;
}

}  // namespace

VesselIndex::VesselIndex(std::vector<vascular::SphereTree> frames, const Vector3d& p_access,
                         const std::vector<std::pair<std::string, Vector3d>>& named,
                         std::vector<std::vector<Vector3d>> breath)
    : frames_(std::move(frames)), breath_(std::move(breath)) {
  const std::vector<vascular::TreeBranch>& all = branches();
  for (std::size_t b = 0; b < all.size(); ++b) {
    offset_.push_back(static_cast<int>(nodes_.size()));
    const double mouth_m =
        all[b].parent < 0 ? 0 : radius_at_mouth(all[static_cast<std::size_t>(all[b].parent)], all[b].parent_sphere);
    for (std::size_t s = 0; s < all[b].spheres.size(); ++s) {
      Node& node = nodes_.emplace_back();
      node.branch = static_cast<int>(b), node.in_branch = static_cast<int>(s);
      if (all[b].parent < 0) continue;
      const vascular::TreeSphere& from = all[static_cast<std::size_t>(all[b].parent)].spheres[all[b].parent_sphere];
      // A branch that continues its parent's line (LAD after LM) is outside the parent at once.
      node.inside_parent = s + 1 < all[b].spheres.size() && (s == 0 || nodes_[nodes_.size() - 2].inside_parent) &&
                           (all[b].spheres[s].p - from.p).norm() < mouth_m;
    }
  }
  std::vector<std::vector<int>> neighbours(nodes_.size());
  const auto join = [&](int a, int b) {
    neighbours[static_cast<std::size_t>(a)].push_back(b);
    neighbours[static_cast<std::size_t>(b)].push_back(a);
  };
  for (std::size_t b = 0; b < all.size(); ++b) {
    for (std::size_t s = 1; s < all[b].spheres.size(); ++s)
      join(offset_[b] + static_cast<int>(s) - 1, offset_[b] + static_cast<int>(s));
    if (all[b].parent >= 0) join(offset_[b], offset_[static_cast<std::size_t>(all[b].parent)] + all[b].parent_sphere);
  }
  // Depth first from the access; a root that is not connected stays at infinity and beyond nothing.
  for (Node& node : nodes_) node.from_access_m = std::numeric_limits<double>::infinity(), node.first = node.last = -1;
  struct Visit {
    int node, from;
    std::size_t next;
  };
  const int root = locate(p_access, 0);
  std::vector<Visit> stack{{root, -1, 0}};
  int count = 0;
  nodes_[static_cast<std::size_t>(root)].from_access_m = 0;
  nodes_[static_cast<std::size_t>(root)].first = count++;
  while (!stack.empty()) {
    Visit& at = stack.back();
    Node& node = nodes_[static_cast<std::size_t>(at.node)];
    const std::vector<int>& around = neighbours[static_cast<std::size_t>(at.node)];
    if (at.next == around.size()) {
      node.last = count;
      stack.pop_back();
      continue;
    }
    const int to = around[at.next++];
    if (to == at.from) continue;
    Node& far = nodes_[static_cast<std::size_t>(to)];
    far.from_access_m = node.from_access_m + (p(to, 0) - p(at.node, 0)).norm();
    far.first = count++;
    stack.push_back({to, at.node, 0});
  }
  for (const auto& [name, point] : named) named_.emplace_back(name, nearest(point));
}

int VesselIndex::nearest(const Vector3d& point) const {
  int best = 0;
  for (int n = 0; n < static_cast<int>(nodes_.size()); ++n)
    if ((p(n, 0) - point).squaredNorm() < (p(best, 0) - point).squaredNorm()) best = n;
  return best;
}

std::size_t VesselIndex::frame_at(double phase) const {
  const auto count = static_cast<double>(frames_.size());
  return static_cast<std::size_t>(std::lround(phase * count)) % frames_.size();
}

Vector3d VesselIndex::p(int sphere, double phase) const {
  const Node& node = nodes_[static_cast<std::size_t>(sphere)];
  return frames_[frame_at(phase)].branches[static_cast<std::size_t>(node.branch)].spheres[node.in_branch].p;
}

VesselIndex::Departure VesselIndex::departure(int sphere, double phase) const {
  const std::vector<vascular::TreeBranch>& all = frames_[frame_at(phase)].branches;
  const vascular::TreeBranch& it = all[static_cast<std::size_t>(branch(sphere))];
  if (it.parent < 0) return {};
  const std::vector<vascular::TreeSphere>& parent = all[static_cast<std::size_t>(it.parent)].spheres;
  const int from = it.parent_sphere, last = static_cast<int>(parent.size()) - 1;
  const Vector3d along = (parent[std::min(from + 1, last)].p - parent[std::max(from - 1, 0)].p).normalized();
  // The branch's own line: the parent's is off the middle where a plaque lies on one side.
  const int first = offset_[static_cast<std::size_t>(branch(sphere))];
  int out = std::min(first + 1, first + static_cast<int>(it.spheres.size()) - 1);
  while (nodes_[static_cast<std::size_t>(out)].inside_parent) ++out;
  const Vector3d to = p(out, phase) - p(first, phase);
  return {along, (to - to.dot(along) * along).normalized()};
}

double VesselIndex::apart_m(const Vector3d& point, const std::vector<vascular::TreeBranch>& all, std::size_t branch,
                            std::size_t sphere, double breath) const {
  const vascular::TreeSphere& it = all[branch].spheres[sphere];
  const bool breathes = breath != 0 && !breath_.empty();
  const Vector3d from = breathes ? Vector3d(point - breath * breath_[branch][sphere]) : point;
  return (it.p - from).norm() - it.radius_m;
}

bool VesselIndex::in_parent(int sphere, const Vector3d& point, double phase, double breath) const {
  const std::vector<vascular::TreeBranch>& all = frames_[frame_at(phase)].branches;
  const int parent = all[static_cast<std::size_t>(branch(sphere))].parent;
  if (parent < 0) return false;
  const auto b = static_cast<std::size_t>(parent);
  for (std::size_t s = 0; s < all[b].spheres.size(); ++s)
    if (apart_m(point, all, b, s, breath) < 0) return true;
  return false;
}

int VesselIndex::locate(const Vector3d& point, double phase, double breath) const {
  const std::vector<vascular::TreeBranch>& all = frames_[frame_at(phase)].branches;
  int best = 0, n = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < all.size(); ++b)
    for (std::size_t s = 0; s < all[b].spheres.size(); ++s) {
      const double apart = apart_m(point, all, b, s, breath);
      if (apart < nearest && !nodes_[static_cast<std::size_t>(n)].inside_parent) nearest = apart, best = n;
      ++n;
    }
  return best;
}

bool VesselIndex::beyond(int sphere, int place) const {
  const Node &a = nodes_[static_cast<std::size_t>(sphere)], &b = nodes_[static_cast<std::size_t>(place)];
  return a.first >= 0 && b.first >= 0 && b.first <= a.first && a.first < b.last;
}

double VesselIndex::between_m(int a, int b) const {
  double parts_m = 0;  // where their ways from the access part
  for (std::size_t c = 0; c < nodes_.size(); ++c)
    if (beyond(a, static_cast<int>(c)) && beyond(b, static_cast<int>(c)))
      parts_m = std::max(parts_m, nodes_[c].from_access_m);
  return from_access_m(a) + from_access_m(b) - 2 * parts_m;
}

double VesselIndex::astray_m(int sphere, int branch) const {
  int left = -1, at = this->branch(sphere);
  while (at >= 0 && at != branch) left = at, at = branches()[static_cast<std::size_t>(at)].parent;
  if (at < 0) return -1;
  if (left < 0) return 0;
  const int from = offset_[static_cast<std::size_t>(branch)] + branches()[static_cast<std::size_t>(left)].parent_sphere;
  return std::max(0.0, from_access_m(sphere) - from_access_m(from));
}

int VesselIndex::entry(const std::string& branch) const {
  for (std::size_t b = 0; b < branches().size(); ++b) {
    if (branches()[b].name != branch) continue;
    int best = -1;
    for (int n = offset_[b]; n < offset_[b] + static_cast<int>(branches()[b].spheres.size()); ++n)
      if (!nodes_[static_cast<std::size_t>(n)].inside_parent && (best < 0 || from_access_m(n) < from_access_m(best)))
        best = n;
    return best;
  }
  return -1;
}

int VesselIndex::place(const std::string& name) const {
  for (const auto& [known, sphere] : named_)
    if (known == name) return sphere;
  if (const int whole = entry(name); whole >= 0) return whole;
  const std::size_t sign = name.find_last_of("+-");
  if (sign == std::string::npos) return -1;
  const std::optional<double> mm = data::decimal(std::string_view(name).substr(sign + 1));
  const int from = entry(name.substr(0, sign));
  if (from < 0 || !mm || *mm < 0) return -1;
  return name[sign] == '+' ? place_beyond(from, 1e-3 * *mm) : place_before(from, 1e-3 * *mm);
}

int VesselIndex::place_beyond(int from, double by_m) const {
  for (int n = 0; n < static_cast<int>(nodes_.size()); ++n)
    if (branch(n) == branch(from) && beyond(n, from) && from_access_m(n) - from_access_m(from) >= by_m) return n;
  return -1;
}

int VesselIndex::place_before(int entered, double by_m) const {
  const vascular::TreeBranch& it = branches()[static_cast<std::size_t>(branch(entered))];
  if (it.parent < 0) return -1;
  const int from = offset_[static_cast<std::size_t>(it.parent)] + it.parent_sphere;
  if (from_access_m(from) > from_access_m(entered)) return -1;  // it comes before the vessel that it leaves
  int best = -1;
  for (int n = 0; n < static_cast<int>(nodes_.size()); ++n)
    if (beyond(from, n) && from_access_m(from) - from_access_m(n) >= by_m &&
        (best < 0 || from_access_m(n) > from_access_m(best)))
      best = n;
  return best;
}

std::vector<std::string> VesselIndex::places() const {
  std::vector<std::string> names;
  for (const auto& [name, sphere] : named_) names.push_back(name);
  for (const vascular::TreeBranch& branch : branches()) names.push_back(branch.name);
  return names;
}

}  // namespace ostium::app
