#include "core/contact/sleep.h"

#include <algorithm>
#include <cmath>

namespace ostium::core {

namespace {

constexpr float rounding_m = 1e-7F;
constexpr double longest_way_m = 0.05;  ///< single precision resolves it to 4 nm

/// What counts in a step is how a node moves relative to the middle of a leaf's box, and how the leaf's corners move
/// beside that middle. If corners move by at most s relative to the reference, each coordinate of the middle does, so
/// both together are at most s (1 + 2 sqrt 3) more than the node's motion relative to the reference. What all corners
/// have in common only counts once.
constexpr double own_moves = 4.5;

/// Where an edit moves each corner by at most s, a leaf and the middle of the reference's box part by at most
/// s (1 + sqrt 3).
constexpr double edit_moves = 2.8;

constexpr double rounded_up = 1 + 1e-6;

void wake_all(KeptLeaves& kept) {
  for (KeptLeaves::Sleep& one : kept.sleep) one.wakes_at_m = -1;
  kept.way_m = kept.frames = 0;
}

/// Adds how far nodes and walls have come since the last step began. False if that cannot be told.
bool go_on(const Surface& surface, const SurfaceMoment& now, const NodeBlock& nodes, KeptLeaves& kept) {
  const bool stays = now.interval == kept.in_interval, next = kept.to_next_m > 0 && now.interval == kept.interval;
  if (kept.nodes != nodes.nodes || kept.shift_W != now.shift_W || !(next || (stays && now.interval == kept.interval)))
    return false;
  const V3<double> reference = middle_of(surface, kept.reference, now);
  double came = 0;
  for (int k = 0; k < nodes.nodes; ++k)
    came = largest(came, norm(nodes.at(k) - reference - kept.seen[k]) + largest(0, nodes.reach[k] - kept.reach[k]));
  kept.way_m += came + kept.sway_m * std::fabs(now.sway - kept.sway) + edit_moves * (surface.moved_m - kept.moved_m) +
                (next ? kept.to_next_m : 0);
  kept.frames += next ? now.share : std::fabs(now.share - kept.share);
  return kept.way_m <= longest_way_m;
}

/// The leaf nearest to the middle of the searched box.
int choose_reference(const Surface& surface, const LeafList& list) {
  const V3<double> middle = 0.5 * (list.low + list.high);
  double nearest2 = 1e9;
  int chosen = 0;
  const Box* boxes = boxes_of(surface, list.interval);
  for (const int leaf : list.leaves) {
    const BoxEnds box = BoxEnds::of(boxes[leaf]);
    const V3<double> away = 0.5 * (box.lowest() + box.highest()) - middle;
    if (dot(away, away) < nearest2) nearest2 = dot(away, away), chosen = leaf;
  }
  return chosen;
}

/// Sets how fast a leaf moves.
void set_speed(const Surface& surface, const KeptLeaves& kept, KeptLeaves::Sleep& one) {
  const int cluster = surface.nodes[one.node].cluster;
  const RelativeSpeed speed = relative_speed(surface, kept.interval, cluster, surface.nodes[kept.reference].cluster);
  one.version = surface.clusters[cluster].version;
  one.speed_m = static_cast<float>(rounded_up * (speed.middle + speed.beside));
  one.nears_m = static_cast<float>(rounded_up * (speed.middle + own_moves * speed.beside));
}

/// What is left of a leaf's clearance, less the rounding.
float left_m(const KeptLeaves& kept, const KeptLeaves::Sleep& one) {
  return one.wakes_at_m - static_cast<float>(kept.way_m + one.speed_m * kept.frames) - rounding_m;
}

/// Begins with a new list: those of its leaves that were on the last one sleep on. Both are in the order of the tree.
void begin(const Surface& surface, KeptLeaves& kept) {
  const LeafList& list = kept.list;
  std::swap(kept.sleep, kept.before);
  kept.sleep.clear();
  kept.reference = choose_reference(surface, list);
  kept.sway_m = 0;
  kept.made = list.made, kept.interval = list.interval;
  auto was = kept.before.begin();
  for (const int leaf : list.leaves) {
    while (was != kept.before.end() && was->node < leaf) ++was;
    KeptLeaves::Sleep& one = kept.sleep.emplace_back();
    one.node = leaf;
    one.wakes_at_m = was != kept.before.end() && was->node == leaf ? left_m(kept, *was) : -1;
    set_speed(surface, kept, one);
    kept.sway_m = std::max(kept.sway_m, relative_sway(surface, leaf, kept.reference));
  }
  kept.way_m = kept.frames = 0;
}

/// After edits: leaves that were changed move otherwise.
void renew_speeds(const Surface& surface, KeptLeaves& kept) {
  const auto changed = [&](const KeptLeaves::Sleep& one) {
    return one.version != surface.clusters[surface.nodes[one.node].cluster].version;
  };
  const bool all = std::any_of(kept.sleep.begin(), kept.sleep.end(), [&](const KeptLeaves::Sleep& one) {
    return one.node == kept.reference && changed(one);
  });
  for (KeptLeaves::Sleep& one : kept.sleep) {
    if (!all && !changed(one)) continue;
    const float left = left_m(kept, one);
    set_speed(surface, kept, one);
    one.wakes_at_m = left + static_cast<float>(kept.way_m + one.speed_m * kept.frames) - rounding_m;
  }
}

/// How far any leaf moves relative to the reference from a moment until the next interval begins, at most.
double until_next_m(const Surface& surface, const SurfaceMoment& now, const KeptLeaves& kept) {
  double fastest = 0;
  for (const KeptLeaves::Sleep& one : kept.sleep) {
    const RelativeSpeed speed =
        relative_speed(surface, now.interval, surface.nodes[one.node].cluster, surface.nodes[kept.reference].cluster);
    fastest = largest(fastest, speed.middle + speed.beside);
  }
  return rounded_up * fastest * (1 - now.share) + 1e-9;
}

}  // namespace

SleepWatch::SleepWatch(const Surface& surface, const SurfacePose& pose, const NodeBlock& nodes, KeptLeaves& kept)
    : kept_(kept) {
  if (kept.list.leaves.empty()) {
    kept.nodes = 0;
    return;
  }
  const SurfaceMoment &a = pose.before, &b = pose.after;
  if (!go_on(surface, a, nodes, kept)) wake_all(kept);
  if (kept.made != kept.list.made)
    begin(surface, kept);
  else if (kept.edits != surface.edits)
    renew_speeds(surface, kept);
  const V3<double> before = middle_of(surface, kept.reference, a),
                   drift = middle_of(surface, kept.reference, b) - before;
  double moves = 0;
  for (int k = 0; k < nodes.nodes; ++k) {
    moves = largest(moves, norm(nodes.move(k) - drift));
    kept.seen[k] = nodes.at(k) - before, kept.reach[k] = nodes.reach[k];
  }
  const bool passes = a.interval != b.interval;
  kept.nodes = nodes.nodes, kept.in_interval = a.interval, kept.share = a.share, kept.sway = a.sway;
  kept.edits = surface.edits, kept.moved_m = surface.moved_m, kept.shift_W = a.shift_W;
  kept.to_next_m = passes ? until_next_m(surface, a, kept) : 0;
  now_m_ = static_cast<float>(kept.way_m + moves + own_moves * kept.to_next_m +
                              own_moves * kept.sway_m * std::fabs(b.sway - a.sway)) +
           rounding_m;
  frames_ = static_cast<float>(kept.frames) + rounding_m;
  step_frames_ = static_cast<float>(passes ? b.share : std::fabs(b.share - a.share)) + rounding_m;
}

void SleepWatch::lay_down(std::size_t n, double clearance_m) {
  KeptLeaves::Sleep& one = kept_.sleep[n];
  one.wakes_at_m = static_cast<float>(kept_.way_m + one.speed_m * kept_.frames + clearance_m) - rounding_m;
}

}  // namespace ostium::core
