#include "core/contact/sleep.h"

#include <algorithm>
#include <cmath>

namespace ostium::core {

namespace {

constexpr float rounding_m = 1e-7F;
constexpr double longest_way_m = 0.05;  ///< single precision resolves it to 4 nm

/// A step's motion relative to a leaf is how a node moves relative to the middle of the leaf's box, and how its corners
/// move beside that middle. If each corner moves by at most s relative to the reference, each coordinate of the middle
/// does, so both together are at most s (1 + 2 sqrt 3) more than the node's motion relative to the reference.
constexpr double own_moves = 4.5;

/// Where each corner is moved aside by at most s, a leaf and the middle of the reference's box part by at most
/// s (1 + sqrt 3).
constexpr double moves_aside = 2.8;

void wake_all(KeptLeaves& kept) {
  for (KeptLeaves::Sleep& one : kept.sleep) one.wakes_at_m = -1;
  kept.way_m = kept.frames = 0;
}

/// The leaf nearest to the middle of the searched box becomes the reference.
void begin(const Surface& surface, KeptLeaves& kept) {
  const LeafList& list = kept.list;
  const V3<double> middle = 0.5 * (list.low + list.high);
  double nearest2 = 1e9;
  for (const LeafList::Leaf& leaf : list.leaves) {
    const BoxEnds box = BoxEnds::of(leaf.box);
    const V3<double> away = 0.5 * (box.lowest() + box.highest()) - middle;
    if (dot(away, away) < nearest2) nearest2 = dot(away, away), kept.reference = leaf.node;
  }
  kept.sleep.clear();
  kept.sway_m = 0;
  for (const LeafList::Leaf& leaf : list.leaves) {
    constexpr double rounded_up = 1 + 1e-6;
    const double speed =
        relative_speed(surface, list.interval, surface.nodes[leaf.node].cluster, surface.nodes[kept.reference].cluster);
    kept.sleep.push_back({static_cast<float>(rounded_up * speed), 0});
    kept.sway_m = std::max(kept.sway_m, relative_sway(surface, leaf.node, kept.reference));
  }
  kept.made = list.made;
  wake_all(kept);
}

}  // namespace

SleepWatch::SleepWatch(const Surface& surface, const SurfacePose& pose, const NodeBlock& nodes, KeptLeaves& kept)
    : kept_(kept) {
  if (kept.list.leaves.empty()) return;
  const SurfaceMoment &a = pose.before, &b = pose.after;
  const bool fresh = kept.made != kept.list.made;
  if (fresh)
    begin(surface, kept);
  else if (kept.nodes != nodes.nodes || kept.way_m > longest_way_m)
    wake_all(kept);
  const V3<double> before = middle_of(surface, kept.reference, a),
                   drift = middle_of(surface, kept.reference, b) - before;
  double came = 0, moves = 0;
  for (int k = 0; k < nodes.nodes; ++k) {
    const V3<double> p = nodes.at(k) - before;
    came = largest(came, norm(p - kept.seen[k]) + largest(0, nodes.reach[k] - kept.reach[k]));
    moves = largest(moves, norm(nodes.move(k) - drift));
    kept.seen[k] = p, kept.reach[k] = nodes.reach[k];
  }
  if (!fresh && kept.nodes == nodes.nodes) {
    kept.way_m +=
        came + kept.sway_m * std::fabs(a.sway - kept.sway) + moves_aside * (surface.aside_way_m - kept.aside_way_m);
    kept.frames += std::fabs(a.share - kept.share);
  }
  kept.nodes = nodes.nodes, kept.share = a.share, kept.sway = a.sway, kept.aside_way_m = surface.aside_way_m;
  now_m_ = static_cast<float>(kept.way_m + moves + own_moves * kept.sway_m * std::fabs(b.sway - a.sway)) + rounding_m;
  frames_ = static_cast<float>(kept.frames + own_moves * std::fabs(b.share - a.share)) + rounding_m;
}

void SleepWatch::lay_down(std::size_t n, double clearance_m) {
  KeptLeaves::Sleep& one = kept_.sleep[n];
  one.wakes_at_m = static_cast<float>(kept_.way_m + one.speed_m * kept_.frames + clearance_m) - rounding_m;
}

}  // namespace ostium::core
