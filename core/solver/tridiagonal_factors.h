#pragma once
/// Working memory of a solve, by number of rolls.
#include <tuple>

#include "core/solver/block.h"
#include "core/solver/block_tridiagonal.h"

namespace ostium::core {

inline constexpr int between_halts = 8;  ///< steps; a halt is as large as a block, and resumed only a few steps back

struct TridiagonalFactors::Blocks {
  template <int R>
  struct OfRolls {
    std::vector<TridiagonalBlock<R>> blocks;
    std::vector<EliminationHalt<R>> halts;
  };
  std::tuple<OfRolls<0>, OfRolls<1>, OfRolls<2>, OfRolls<3>> by_rolls;
};

template <int R>
std::vector<TridiagonalBlock<R>>& TridiagonalFactors::blocks() {
  return std::get<R>(blocks_->by_rolls).blocks;
}
template <int R>
const std::vector<TridiagonalBlock<R>>& TridiagonalFactors::blocks() const {
  return std::get<R>(blocks_->by_rolls).blocks;
}
template <int R>
std::vector<EliminationHalt<R>>& TridiagonalFactors::halts() {
  return std::get<R>(blocks_->by_rolls).halts;
}

}  // namespace ostium::core
