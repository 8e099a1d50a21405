#pragma once
/// One Newton step of a rod: a symmetric block-tridiagonal saddle-point system, solved directly in time linear in the
/// elements.
///
/// Unknowns per element j: its turn phi_j (world frame, rad) and its internal force n_j (world frame, N, what the
/// distal side does to the proximal one). With d_j = l_j d3_j, [d]x the cross product, H and m the stiffness and moment
/// of joints, P the compliance of nodes (displacement per force, m/N):
///
///   K_j phi_j - [d_j]x n_j + (-H_j+1 + [m_j+1]x / 2) phi_j+1 + (-H_j - [m_j]x / 2) phi_j-1 = torque_j
///   [d_j]x phi_j - (P_j + P_j+1) n_j + P_j+1 n_j+1 + P_j n_j-1                             = gap_j
///
/// plus, in A_j = P_j + P_j+1, the give c d d^T of tolerances.h: without it, the tension between two held ends of a
/// straight rod would be anything.
///
/// Where rods run inside one another, elements also have rolls: turns psi of further frames about d3, one `Roll` each,
/// that only joints couple, among themselves and to the turns. A roll m adds to the energy, element by element and
/// joint by joint,
///   k psi_j^2 / 2 + psi_j b_j . phi_j - torque psi_j + phi_j . u_j+1 psi_j+1 + psi_j w_j+1 . phi_j+1
///   + c_j+1 psi_j psi_j+1 + beside_j psi_j (roll m - 1)_j
///
/// A node that is held in a direction has a P without that direction, whatever its mass: rigid constraints at nodes
/// cost nothing and leave the system well conditioned.
///
/// Method: block LDL^T from both ends towards the middle (a twisted factorisation). The two halves of a rod, and of a
/// second rod, run side by side in the four lanes of a register, so two rods cost as much as one.
#include <memory>
#include <vector>

#include "core/math/field.h"

namespace ostium::core {

/// Most rolls of a chain.
inline constexpr int max_rolls = 3;

struct Roll {
  explicit Roll(int elements);

  Field<1> stiffness;  ///< k_j, N m/rad, (#elements), > 0
  Field<1> beside;     ///< N m/rad, (#elements)
  Field<3> with_turn;  ///< b_j, N m/rad, (#elements)
  Field<3> ahead;      ///< u_i, N m/rad, (#nodes): of the element before joint i and the roll behind it
  Field<3> behind;     ///< w_i, N m/rad, (#nodes): of the roll before it and the element behind
  Field<1> both;       ///< c_i, N m/rad, (#nodes)
  Field<1> torque;     ///< N m, (#elements)
  Field<1> turn;       ///< the solution psi_j, rad, (#elements)
};

struct BlockTridiagonal {
  explicit BlockTridiagonal(int elements = 0, int rolls = 0);

  int elements = 0;  ///< N
  int first = 0;     ///< the system is that of elements first to N - 1, nodes first to N; at least 3 elements
  // --- the system; every field has N + 1 entries, so that all share one stride
  Field<6> stiffness;        ///< K_j, N m/rad, (#elements)
  Field<6> joint_stiffness;  ///< H_i, N m/rad, (#nodes); inner joints couple, 1 <= i < N
  Field<3> joint_moment;     ///< m_i, N m, (#nodes)
  Field<3> arm;              ///< d_j, m, (#elements)
  Field<6> compliance;       ///< P_i, m/N, (#nodes), positive semi-definite, P_j + P_j+1 regular
  Field<3> torque;           ///< N m, (#elements)
  Field<3> gap;              ///< m, (#elements)
  std::vector<Roll> rolls;   ///< at most max_rolls; the first `roll_count` are in use
  int roll_count = 0;
  // --- the solution
  Field<3> turn;         ///< phi_j, rad, (#elements)
  Field<3> force;        ///< n_j, N, (#elements)
  bool definite = true;  ///< every motion that the constraints leave costs energy; else the solution leads to a saddle
};

/// What is eliminated at one element, in four chains side by side, each with R rolls.
template <int R>
struct TridiagonalBlock;
/// An elimination between two elements, to go on from there.
template <int R>
struct EliminationHalt;

/// Working memory of a solve: any content is fine on entry. Afterwards it holds the pivots.
class TridiagonalFactors {
 public:
  TridiagonalFactors();
  ~TridiagonalFactors();
  TridiagonalFactors(TridiagonalFactors&&) noexcept;
  TridiagonalFactors& operator=(TridiagonalFactors&&) noexcept;

  /// Makes room for two chains of at most `elements` and `rolls` each.
  void resize(int elements, int rolls = 0);
  template <int R>
  std::vector<TridiagonalBlock<R>>& blocks();
  template <int R>
  const std::vector<TridiagonalBlock<R>>& blocks() const;
  template <int R>
  std::vector<EliminationHalt<R>>& halts();

 private:
  struct Blocks;
  std::unique_ptr<Blocks> blocks_;
};

/// Solves one chain, or two at once (`second` may be null; it may be shorter or longer, with as many rolls); `factors`
/// has room for the longer. A chain's solution does not depend, to the last bit, on what shares the call. Does not
/// allocate. Two threads may solve different chains with different factors.
void solve(BlockTridiagonal& first, BlockTridiagonal* second, TridiagonalFactors& factors);

/// Solves the chain of the last `solve(chain, nullptr, factors)` or `solve_again` once more, where compliance and gap
/// have changed since, but not of the `same` elements at either end, which are not eliminated again. As `solve` to the
/// last bit.
void solve_again(BlockTridiagonal& chain, int same, TridiagonalFactors& factors);

/// Number of directions in which the system of the last `solve(chain, nullptr, factors)` has negative stiffness, on
/// the space of motions that its constraints leave (Sylvester's law of inertia, from the pivots): 0 where an
/// equilibrium is stable. Of a chain without rolls.
int negative_pivots(const BlockTridiagonal& chain, const TridiagonalFactors& factors);

}  // namespace ostium::core
