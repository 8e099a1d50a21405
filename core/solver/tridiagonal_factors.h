#pragma once
/// Working memory of a solve, by number of rolls.
#include <tuple>

#include "core/solver/block.h"
#include "core/solver/block_tridiagonal.h"

namespace ostium::core {

inline constexpr int between_halts = 8;  ///< steps; a halt is as large as a block, and resumed only a few steps back

struct TridiagonalFactors::Blocks {
  template <class T, int R>
  struct Of {
    std::vector<TridiagonalBlock<T, R>> blocks;
    std::vector<EliminationHalt<T, R>> halts;
  };
  template <class T>
  using ByRolls = std::tuple<Of<T, 0>, Of<T, 1>, Of<T, 2>, Of<T, 3>, Of<T, 4>>;
  std::tuple<ByRolls<Pair>, ByRolls<Lanes>> by_chains;

  template <class T, int R>
  Of<T, R>& of() {
    return std::get<R>(std::get<ByRolls<T>>(by_chains));
  }
};

template <class T, int R>
std::vector<TridiagonalBlock<T, R>>& TridiagonalFactors::blocks() {
  return blocks_->of<T, R>().blocks;
}
template <class T, int R>
const std::vector<TridiagonalBlock<T, R>>& TridiagonalFactors::blocks() const {
  return blocks_->of<T, R>().blocks;
}
template <class T, int R>
std::vector<EliminationHalt<T, R>>& TridiagonalFactors::halts() {
  return blocks_->of<T, R>().halts;
}

}  // namespace ostium::core
