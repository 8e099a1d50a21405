#pragma once
/// The working memory of a solve, by the number of rolls.
#include <tuple>

#include "core/solve/chain.h"
#include "core/solve/chain_block.h"

namespace ostium {

inline constexpr int between_halts = 8;  ///< steps: a halt is as large as a block, and mostly read a few steps early

struct ChainFactors::Blocks {
  template <int R>
  struct OfRolls {
    std::vector<ChainBlock<R>> blocks;
    std::vector<ChainHalt<R>> halts;
  };
  std::tuple<OfRolls<0>, OfRolls<1>, OfRolls<2>, OfRolls<3>> by_rolls;
};

template <int R>
std::vector<ChainBlock<R>>& ChainFactors::blocks() {
  return std::get<R>(blocks_->by_rolls).blocks;
}
template <int R>
const std::vector<ChainBlock<R>>& ChainFactors::blocks() const {
  return std::get<R>(blocks_->by_rolls).blocks;
}
template <int R>
std::vector<ChainHalt<R>>& ChainFactors::halts() {
  return std::get<R>(blocks_->by_rolls).halts;
}

}  // namespace ostium
