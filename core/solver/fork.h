#pragma once
/// One Newton step of chains that fork: branches that share the last node of a trunk, and whose first elements are
/// joined to frames of its last element.
///
/// A branch is a chain whose first node has no compliance of its own: it lies where the trunk's last node does, at
/// x = target + move. Joint k of a branch joins the frame of roll `roll` of the trunk's last element, which turns by
/// theta = phi + psi d3, to a frame of the branch's first one. With H, m the joint's stiffness and moment and
/// X = -H + [m]x / 2 the coupling of the two turns (block_tridiagonal.h), a branch that is eliminated from its tip
/// leaves
///
///   F = c_x - S_xx move - S_xt y,    M = c_t - S_tx move - S_tt y
///
/// on the node and on y = (phi, psi of each joint). The node's own balance, move = P (F - n), is solved for the move,
///
///   move = P' (c_x - S_xt y - n),    P' = (1 + P S_xx)^-1 P,
///
/// and what remains is one more row of the trunk's last element (TipRow). So the whole is solved directly, in time
/// linear in the number of elements, however stiff the branches are.
#include <span>

#include "core/solver/block_tridiagonal.h"

namespace ostium::core {

/// Joins one frame of the trunk's last element to one of the branch's first element.
struct BranchJoint {
  int roll = 0;       ///< of the trunk: the frame that is joined
  int own_roll = -1;  ///< of the branch; -1: the frame that turns with the chain
  S3<double> stiffness{};
  V3<double> moment{};
  V3<double> axis{}, own_axis{};  ///< d3 of the two frames
};

/// Most branches of a fork.
inline constexpr int max_branches = 3;

struct ForkBranch {
  BlockTridiagonal* chain = nullptr;  ///< its first node's compliance is zero; its first row includes the joints
  TridiagonalFactors* factors = nullptr;
  int joint_count = 0;
  BranchJoint joints[max_rolls];
};

/// Solves a trunk and its branches; each has factors of its own. `geometric`: 0.5, or 0 where the couplings leave out
/// what moments add. All chains are `definite` or none is. `from`: as in solve_within, to the trunk's tip, where only
/// these elements of the trunk have changed since the last call; -1: all may have. False: as many were solved as all.
/// Does not allocate.
bool solve_fork(BlockTridiagonal& trunk, TridiagonalFactors& factors, std::span<ForkBranch* const> branches,
                double geometric, int from = -1);

}  // namespace ostium::core
