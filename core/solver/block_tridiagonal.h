#pragma once
/// One Newton step of a rod: a symmetric block-tridiagonal saddle-point system, solved directly in time linear in the
/// number of elements.
///
/// Unknowns per element j: its turn phi_j (world frame, rad) and its internal force n_j (world frame, N, distal on
/// proximal side). With d_j = l_j d3_j, [d]x the cross product, H and m the stiffness and moment of joints, P the
/// compliance of nodes (displacement per force, m/N):
///
///   K_j phi_j - [d_j]x n_j + (-H_j+1 + [m_j+1]x / 2) phi_j+1 + (-H_j - [m_j]x / 2) phi_j-1 = torque_j
///   [d_j]x phi_j - (P_j + P_j+1) n_j + P_j+1 n_j+1 + P_j n_j-1                             = gap_j
///
/// plus, in A_j = P_j + P_j+1, the axial compliance c d d^T of tolerances.h: without it, the tension between two held
/// ends of a straight rod would be undetermined.
///
/// Where rods run inside one another, elements also have rolls: turns psi of further frames about d3, one `Roll` each,
/// coupled only by joints, to each other and to the turns. Roll m adds to the energy, per element and per joint,
///   k psi_j^2 / 2 + psi_j b_j . phi_j - torque psi_j + phi_j . u_j+1 psi_j+1 + psi_j w_j+1 . phi_j+1
///   + c_j+1 psi_j psi_j+1 + beside_j psi_j (roll m - 1)_j
///
/// A node that is held in a direction has a P without that direction, regardless of its mass: rigid constraints at
/// nodes cost nothing and leave the system well conditioned.
///
/// Method: block LDL^T from both ends towards the middle (a twisted factorisation). The two halves of a rod occupy the
/// two lanes of half a register; with a second rod's they fill a whole one, so two rods cost little more than one.
#include <memory>
#include <vector>

#include "core/math/field.h"

namespace ostium::core {

/// Most rolls of a chain.
inline constexpr int max_rolls = 4;

struct Roll {
  explicit Roll(int elements);

  Field<1> stiffness;  ///< k_j, N m/rad, (#elements), > 0
  Field<1> beside;     ///< N m/rad, (#elements)
  Field<3> with_turn;  ///< b_j, N m/rad, (#elements)
  Field<3> ahead;      ///< u_i, N m/rad, (#nodes): turn of the element before joint i, roll of the one after
  Field<3> behind;     ///< w_i, N m/rad, (#nodes): roll of the element before, turn of the one after
  Field<1> both;       ///< c_i, N m/rad, (#nodes)
  Field<1> torque;     ///< N m, (#elements)
  Field<1> turn;       ///< the solution psi_j, rad, (#elements)
};

/// What the branches of a fork add to the row of the element that they leave (fork.h), in the notation above:
/// [K G; G^T -A], torque and gap.
struct TipRow {
  S3<double> K{};
  V3<double> with_roll[max_rolls]{};        ///< K's entries between the turn and each roll, and
  double rolls[max_rolls][max_rolls] = {};  ///< between rolls
  M3<double> G{};
  V3<double> roll_G[max_rolls]{};
  S3<double> A{};
  V3<double> torque{};
  double roll_torque[max_rolls] = {};
  V3<double> gap{};
};

struct BlockTridiagonal {
  explicit BlockTridiagonal(int elements = 0, int rolls = 0);

  int elements = 0;  ///< N
  int first = 0;     ///< the system is that of elements first to N - 1, nodes first to N; at least 3 elements
  // --- the system; every field has N + 1 entries, so that all have the same stride
  Field<6> stiffness;        ///< K_j, N m/rad, (#elements)
  Field<6> joint_stiffness;  ///< H_i, N m/rad, (#nodes); inner joints couple, 1 <= i < N
  Field<3> joint_moment;     ///< m_i, N m, (#nodes)
  Field<3> arm;              ///< d_j, m, (#elements)
  Field<6> compliance;       ///< P_i, m/N, (#nodes), positive semi-definite, P_j + P_j+1 regular
  Field<3> torque;           ///< N m, (#elements)
  Field<3> gap;              ///< m, (#elements)
  std::vector<Roll> rolls;   ///< at most max_rolls; the first `roll_count` are in use
  int roll_count = 0;
  bool forks = false;  ///< branches hang on the tip; then
  TipRow branches;     ///< is what they add
  // --- the solution
  Field<3> turn;         ///< phi_j, rad, (#elements)
  Field<3> force;        ///< n_j, N, (#elements)
  V3<double> pull{};     ///< N, of the branches on the tip; zero without
  int meets_at = 0;      ///< element at which the eliminations from both ends met
  bool in_part = false;  ///< only a stretch of the solution is that of the last solve (solve_within)
  bool definite = true;  ///< every motion within the constraints costs energy; else the solution is a saddle point
};

/// Factors of one element in each half of a chain, or of two, side by side; each chain has R rolls.
template <class T, int R>
struct TridiagonalBlock;
/// State of an elimination between two elements, from which it can resume.
template <class T, int R>
struct EliminationHalt;

/// Working memory of a solve; any content is fine on entry. Afterwards it holds the pivots.
class TridiagonalFactors {
 public:
  TridiagonalFactors();
  ~TridiagonalFactors();
  TridiagonalFactors(TridiagonalFactors&&) noexcept;
  TridiagonalFactors& operator=(TridiagonalFactors&&) noexcept;

  /// Makes room for two chains of at most `elements` and `rolls` each.
  void resize(int elements, int rolls = 0);
  template <class T, int R>
  std::vector<TridiagonalBlock<T, R>>& blocks();
  template <class T, int R>
  const std::vector<TridiagonalBlock<T, R>>& blocks() const;
  template <class T, int R>
  std::vector<EliminationHalt<T, R>>& halts();

 private:
  struct Blocks;
  std::unique_ptr<Blocks> blocks_;
};

/// Solves one chain, or two at once (`second` may be null; it may differ in length but must have as many rolls);
/// `factors` must have room for the longer one. A chain's solution is bit-identical whether or not another one shares
/// the call. Does not allocate. Different threads may solve different chains with different factors.
void solve(BlockTridiagonal& first, BlockTridiagonal* second, TridiagonalFactors& factors);

/// Solves the chain of the last `solve(chain, nullptr, factors)` or `solve_again` once more after compliance and gap
/// have changed, except for the `same` elements at either end, which are not eliminated again. Bit-identical to
/// `solve`; after `solve_within`, all are eliminated again.
void solve_again(BlockTridiagonal& chain, int same, TridiagonalFactors& factors);

/// The same where compliance and gap have changed only in elements `from` to `to`: writes the solution of these alone.
/// The first time, the eliminations go on to meet among them; from then on, only these elements are eliminated again.
/// The same solution as that of `solve`, but for rounding. False, and nothing done, unless the stretch lies beyond the
/// chain's middle.
bool solve_within(BlockTridiagonal& chain, int from, int to, TridiagonalFactors& factors);

/// Writes the rest of the solution after `solve_within`; nothing to do otherwise.
void complete(BlockTridiagonal& chain, const TridiagonalFactors& factors);

/// Number of directions with negative stiffness in the system of the last `solve(chain, nullptr, factors)`, among
/// motions that satisfy its constraints (Sylvester's law of inertia, from the pivots): 0 for a stable equilibrium. For
/// a chain without rolls.
int negative_pivots(const BlockTridiagonal& chain, const TridiagonalFactors& factors);

}  // namespace ostium::core
