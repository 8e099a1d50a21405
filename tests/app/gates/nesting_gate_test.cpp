#include <gtest/gtest.h>

#include "app/verify/nesting.h"

namespace ostium {
namespace {

TEST(Nesting, WithoutTheBindingEveryGateFails) {
  for (const GateResult& gate : verify::nesting_with(true, false)) EXPECT_FALSE(gate.pass()) << gate.gate;
}

}  // namespace
}  // namespace ostium
