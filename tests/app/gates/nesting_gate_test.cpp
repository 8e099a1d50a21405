#include <gtest/gtest.h>

#include "app/gates/nesting.h"

namespace ostium::app {
namespace {

TEST(Nesting, WithoutTheBindingEveryGateFails) {
  for (const data::GateResult& gate : gates::nesting_with(true, false)) EXPECT_FALSE(gate.pass()) << gate.gate;
}

}  // namespace
}  // namespace ostium::app
