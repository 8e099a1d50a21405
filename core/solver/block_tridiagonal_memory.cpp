#include <algorithm>

#include "core/solver/block_tridiagonal_walks.h"
#include "core/solver/tridiagonal_factors.h"

namespace ostium::core {

TridiagonalFactors::TridiagonalFactors() : blocks_(std::make_unique<Blocks>()) {}
TridiagonalFactors::~TridiagonalFactors() = default;
TridiagonalFactors::TridiagonalFactors(TridiagonalFactors&&) noexcept = default;
TridiagonalFactors& TridiagonalFactors::operator=(TridiagonalFactors&&) noexcept = default;

void TridiagonalFactors::resize(int elements, int rolls) {
  const auto make_room = [&](auto& own) {
    own.blocks.resize(std::max<std::size_t>(own.blocks.size(), elements + 1));
    own.halts.resize(own.blocks.size() / between_halts + 1);
  };
  const auto by_rolls = [&]<class T>(T) {
    rolls == 0   ? make_room(blocks_->of<T, 0>())
    : rolls == 1 ? make_room(blocks_->of<T, 1>())
    : rolls == 2 ? make_room(blocks_->of<T, 2>())
    : rolls == 3 ? make_room(blocks_->of<T, 3>())
                 : make_room(blocks_->of<T, 4>());
  };
  by_rolls(Pair{}), by_rolls(Lanes{});
}

namespace {

void write_idle_entries(BlockTridiagonal& chain) {
  for (bool forward : {true, false}) {
    const int i = idle_entry(chain, forward);
    store6(chain.stiffness, i, identity3<double>());
    store6(chain.compliance, forward ? i : i + 1, identity3<double>());
    for (Roll& roll : chain.rolls) roll.stiffness.at(0)[i] = 1;
  }
}

}  // namespace

Roll::Roll(int elements)
    : stiffness(elements + 1),
      beside(elements + 1),
      with_turn(elements + 1),
      ahead(elements + 1),
      behind(elements + 1),
      both(elements + 1),
      torque(elements + 1),
      turn(elements + 1) {}

BlockTridiagonal::BlockTridiagonal(int elements, int rolls)
    : elements(elements),
      stiffness(elements + 1),
      joint_stiffness(elements + 1),
      joint_moment(elements + 1),
      arm(elements + 1),
      compliance(elements + 1),
      torque(elements + 1),
      gap(elements + 1),
      rolls(rolls, Roll(elements)),
      roll_count(rolls),
      turn(elements + 1),
      force(elements + 1) {
  write_idle_entries(*this);
}

}  // namespace ostium::core
