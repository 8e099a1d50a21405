#pragma once
/// Leaves of a wall's tree that a block of nodes cannot meet yet are left alone until it can.
///
/// When a leaf was last looked at, it lay outside of the nodes' reach by some clearance. Since then they have come
/// nearer by no more than
///   way + speed * frames
/// where `way` is how far any node has gone relative to a reference that moves along with the wall (the middle of one
/// of the leaves), and `speed` bounds how the leaf's corners move relative to the same reference within the present
/// interval of the cycle. A leaf sleeps while this is less than its clearance. So the beat of the heart, which carries
/// walls and instruments along, wakes nobody; nor does a new list of leaves, or another interval of the cycle, wake
/// those that are known. Only leaves that would be found out of reach are left out: what contact finds does not depend
/// on who sleeps.
#include "core/contact/node_block.h"

namespace ostium::core {

class SleepWatch {
 public:
  /// `kept.list` must have been renewed for this step. Keeps a reference.
  SleepWatch(const Surface& surface, const SurfacePose& pose, const NodeBlock& nodes, KeptLeaves& kept);

  /// Whether no node can meet leaf n of the list in this step.
  bool sleeps(std::size_t n) const {
    const KeptLeaves::Sleep& one = kept_.sleep[n];
    return now_m_ + one.speed_m * frames_ + one.nears_m * step_frames_ < one.wakes_at_m;
  }
  /// Leaf n is so far outside of the nodes' reach as the step begins; not to be woken before it can be met.
  void lay_down(std::size_t n, double clearance_m);

 private:
  KeptLeaves& kept_;
  float now_m_ = 0;        ///< way by the end of the step
  float frames_ = 0;       ///< until it begins, and
  float step_frames_ = 0;  ///< in it
};

}  // namespace ostium::core
