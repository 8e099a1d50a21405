#pragma once
/// How the lanes of a register, two a chain, run through one or two chains, from the ends towards the middle, and the
/// numbers they read.
#include <algorithm>

#include "core/solver/block.h"
#include "core/solver/block_tridiagonal.h"

namespace ostium::core {

inline constexpr int halves = 2;

/// Where eliminations from both ends take the same time.
inline int middle(const BlockTridiagonal& chain) { return (chain.first + chain.elements) / 2; }

/// The path of one lane: from one end of a chain towards the element where both meet. A lane with fewer elements starts
/// later and idles until then.
struct Walk {
  const BlockTridiagonal* chain;
  bool forward;  ///< starts at the base
  int blocks;    ///< elements before that
  int wait;      ///< steps before it starts

  int element(int t) const { return forward ? chain->first + t - wait : chain->elements - 1 - (t - wait); }
};

/// Index, in a field's padding, of a regular block without coupling: K and the compliance behind are identities, the
/// rest is zero.
/// There are two, since behind and ahead swap for lanes that run the other way; `padded` leaves four entries for them.
inline int idle_entry(const BlockTridiagonal& chain, bool forward) {
  return chain.stiffness.stride() - (forward ? 4 : 2);
}

/// Numbers that an elimination step reads: of its element, the node behind it and the node ahead.
enum Number {
  at_K = 0,
  at_arm = 6,
  at_torque = 9,
  at_gap = 12,
  at_P_behind = 15,
  at_H = 21,
  at_m = 27,
  at_P_ahead = 30,
  numbers = 36
};
/// And of each roll.
enum RollNumber {
  at_k = 0,
  at_b = 1,
  at_beside = 4,
  at_roll_torque = 5,
  at_u = 6,
  at_w = 9,
  at_c = 12,
  roll_numbers = 13
};

/// The lanes of a solve and the numbers they read at each step. T: Pair for one chain, Lanes for two.
template <class T, int R>
class Walks {
 public:
  static constexpr int lanes = sizeof(T) / sizeof(double);

  /// `second` is not looked at where T has room for one chain alone.
  Walks(const BlockTridiagonal& first, const BlockTridiagonal& second) {
    for (int l = 0; l < lanes; ++l) {
      const bool forward = l % halves == 0;
      const BlockTridiagonal& chain = l < halves ? first : second;
      lanes_[l] = {&chain, forward, forward ? chain.meets_at - chain.first : chain.elements - 1 - chain.meets_at, 0};
      direction_[l] = forward ? 1.0 : -1.0;
      steps_ = std::max(steps_, lanes_[l].blocks);
    }
    for (int l = 0; l < lanes; ++l) {
      lanes_[l].wait = steps_ - lanes_[l].blocks;
      // Seen from an element, the node behind is its own when running forward, and the next one when running backward.
      const BlockTridiagonal& c = *lanes_[l].chain;
      const bool forward = lanes_[l].forward;
      const int behind = forward ? 0 : 1, ahead = 1 - behind;
      const auto from = [&](int number, const auto& field, int components, int shift) {
        for (int k = 0; k < components; ++k) source_[number + k][l] = field.at(k) + shift;
      };
      from(at_K, c.stiffness, 6, 0);
      from(at_arm, c.arm, 3, 0);
      from(at_torque, c.torque, 3, 0);
      from(at_gap, c.gap, 3, 0);
      from(at_P_behind, c.compliance, 6, behind);
      from(at_H, c.joint_stiffness, 6, ahead);
      from(at_m, c.joint_moment, 3, ahead);
      from(at_P_ahead, c.compliance, 6, ahead);
      for (int m = 0; m < R; ++m) {
        const Roll& roll = c.rolls[m];
        const int at = numbers + m * roll_numbers;
        from(at + at_k, roll.stiffness, 1, 0);
        from(at + at_b, roll.with_turn, 3, 0);
        from(at + at_beside, roll.beside, 1, 0);
        from(at + at_roll_torque, roll.torque, 1, 0);
        from(at + at_u, forward ? roll.ahead : roll.behind, 3, ahead);
        from(at + at_w, forward ? roll.behind : roll.ahead, 3, ahead);
        from(at + at_c, roll.both, 1, ahead);
      }
    }
  }

  int steps() const { return steps_; }
  T direction() const { return direction_; }
  const Walk& lane(int l) const { return lanes_[l]; }
  /// Whether the first chain has branches that join the elimination from its tip.
  bool forks() const { return lanes_[1].chain->forks && lanes_[1].blocks > 0; }

  /// Sets the lanes' positions at step t.
  void move_to(int t) {
    for (int l = 0; l < lanes; ++l)
      at_[l] = t < lanes_[l].wait ? idle_entry(*lanes_[l].chain, lanes_[l].forward) : lanes_[l].element(t);
  }
  T read(int n) const {
    const auto of = [&](int l) { return source_[n][l][at_[l]]; };
    if constexpr (lanes == halves)
      return T{of(0), of(1)};
    else
      return T{of(0), of(1), of(2), of(3)};
  }
  V3<T> vector(int n) const { return {read(n), read(n + 1), read(n + 2)}; }
  S3<T> symmetric(int n) const { return {read(n), read(n + 1), read(n + 2), read(n + 3), read(n + 4), read(n + 5)}; }
  static int of_roll(int m, int number) { return numbers + m * roll_numbers + number; }

 private:
  Walk lanes_[lanes];
  T direction_{};
  int steps_ = 0;
  const double* source_[numbers + R * roll_numbers][lanes];
  int at_[lanes];
};

}  // namespace ostium::core
