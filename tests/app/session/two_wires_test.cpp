/// Two wires in one guide: which tool runs over which, what lies side by side, and what lacks room; two balloons.
#include <gtest/gtest.h>

#include "app/session/model/session.h"
#include "core/rod/introducer.h"
#include "data/catalogue/catalogue.h"
#include "data/formats/load_error.h"

namespace ostium::app {
namespace {

SessionTool tool(const char* name, const char* instrument, const char* over = "") {
  return {name, data::find_instrument(data::load_catalogue(), instrument), over};
}

std::shared_ptr<const Vessel> patient() {
  static const std::shared_ptr<const Vessel> made = vessel_of(data::find_case("rca-mid-focal"), std::nullopt);
  return made;
}

struct TwoWires {
  SessionModel model;
  SessionState state;
  SessionScratch scratch;
  SessionInputs inputs;
  SessionReport report;

  explicit TwoWires(std::vector<SessionTool> tools)
      : model(make_session(patient(), std::move(tools))),
        state(make_state(model, 0)),
        scratch(model, WallCopy::when_it_opens),
        inputs(inputs_at_rest(model)) {}
  void feed(int t, double mm_s, double seconds) {
    for (ToolInputs& other : inputs.tools) other = {};
    inputs.tools[static_cast<std::size_t>(t)] = {1e-3 * mm_s, 2};
    for (int n = 0; n < 1000 * seconds; ++n) step(model, inputs, state, scratch, report);
  }
  double inserted_m(int t) const { return state.rods.rods[static_cast<std::size_t>(t)].inserted_m; }
};

TEST(TwoWires, LieSideBySideAndGoTheirOwnWays) {
  TwoWires run(
      {tool("guide", "guide-jl4-6f"), tool("wire", "wire-014-workhorse"), tool("second wire", "wire-014-workhorse")});
  run.feed(0, 100, 0.5), run.feed(1, 200, 0.5), run.feed(2, 200, 0.4);
  EXPECT_NEAR(run.inserted_m(1), 0.1, 1e-3);
  EXPECT_NEAR(run.inserted_m(2), 0.08, 1e-3);
  EXPECT_EQ(run.report.refused, -1);
  EXPECT_GT((tip(run.model, run.state, 1) - tip(run.model, run.state, 2)).norm(), 15e-3);
  run.feed(1, -200, 0.6);
  EXPECT_FALSE(run.report.tools[1].in_body);
  EXPECT_TRUE(run.report.tools[2].in_body);
  EXPECT_NEAR(run.inserted_m(2), 0.08, 1e-3) << "the other one stays";
}

TEST(TwoWires, ABalloonGoesOverTheWireThatItSaysAlone) {
  const TwoWires run({tool("guide", "guide-jl4-6f"), tool("balloon", "balloon-20x15", "second wire"),
                      tool("wire", "wire-014-workhorse"), tool("second wire", "wire-014-workhorse")});
  const auto nested = [&](int outer, int inner) {
    for (const core::Nesting& n : run.model.rods.nestings)
      if (n.outer == outer && n.inner == inner) return true;
    return false;
  };
  EXPECT_TRUE(nested(1, 3));
  EXPECT_FALSE(nested(1, 2));
}

TEST(TwoWires, WhatIsNotSaidIsAskedFor) {
  const auto refusal = [](const char* over) -> std::string {
    try {
      TwoWires({tool("guide", "guide-jl4-6f"), tool("balloon", "balloon-20x15", over),
                tool("wire", "wire-014-workhorse"), tool("second wire", "wire-014-workhorse")});
    } catch (const data::LoadError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(""), "balloon goes over wire or second wire: say which, as \"over\": \"wire\"");
  EXPECT_EQ(refusal("third wire"), "balloon runs over \"third wire\"; expected wire or second wire");
  EXPECT_EQ(refusal("wire"), "");
}

TEST(TwoWires, RoomThatLacksIsSaid) {
  TwoWires run({tool("guide", "guide-jl4-6f"), tool("balloon", "balloon-nc-50x20", "wire"),
                tool("second balloon", "balloon-nc-50x20", "second wire"),
                tool("small balloon", "balloon-15x10", "wire"), tool("wire", "wire-014-workhorse"),
                tool("second wire", "wire-014-workhorse")});
  run.feed(0, 100, 0.5), run.feed(1, 100, 0.4);
  ASSERT_TRUE(run.report.tools[1].in_body);
  const Obstacle beside = in_the_way(run.model, run.state.rods, 2), over = in_the_way(run.model, run.state.rods, 3);
  EXPECT_EQ(beside.tool, 1);
  EXPECT_NEAR(beside.lacks_m, 1.0e-3 + 0.86e-3 - 1.8e-3, 1e-9);
  EXPECT_EQ(over.tool, 1) << "two balloons for one wire are exchanged";
  EXPECT_EQ(over.lacks_m, 0);
  EXPECT_EQ(in_the_way(run.model, run.state.rods, 5).tool, -1) << "a wire has room beside a balloon";
  run.feed(2, 100, 0.1);
  EXPECT_EQ(run.report.refused, 2);
  EXPECT_EQ(run.inserted_m(2), 0);
}

TEST(TwoBalloons, EachHasItsDeviceUntilItIsOut) {
  TwoWires run({tool("guide", "guide-jl4-7f"), tool("balloon", "balloon-20x10", "wire"),
                tool("second balloon", "balloon-nc-30x12", "second wire"), tool("wire", "wire-014-workhorse"),
                tool("second wire", "wire-014-workhorse")});
  run.feed(0, 100, 0.5), run.feed(2, 100, 0.45), run.feed(1, 100, 0.4);
  ASSERT_TRUE(run.report.tools[1].in_body && run.report.tools[2].in_body) << "7F has room for both";
  const auto tool_of = [&](int nth) {
    const BalloonInBody own = balloon_in_body(run.state.coupling, run.state.treatment, run.inputs.delivery, nth);
    return own ? own.place->tool : -1;
  };
  EXPECT_EQ(tool_of(0), 2) << "it came first";
  EXPECT_EQ(tool_of(1), 1);
  const auto wait = [&](double seconds) { run.feed(4, 0, seconds); };
  run.inputs.delivery.gauge_Pa = 0, run.inputs.delivery.second_gauge_Pa = 6 * 101325;
  wait(2);
  const auto& balloons = run.state.treatment.balloons;
  EXPECT_GT(balloons[1].pressure_Pa, 4 * 101325);
  EXPECT_LT(balloons[0].pressure_Pa, 0.1 * 101325);
  run.inputs.delivery.gauge_Pa = 6 * 101325, run.inputs.delivery.second_gauge_Pa = -101325;
  wait(4);
  EXPECT_LT(balloons[1].pressure_Pa, 0.5 * 101325);
  EXPECT_GT(balloons[0].pressure_Pa, 4 * 101325);
  run.inputs.delivery.gauge_Pa = -101325;
  run.feed(2, -150, 0.5);
  EXPECT_EQ(tool_of(0), 1) << "what is left is the first";
  EXPECT_EQ(tool_of(1), -1);
  run.inputs.delivery.gauge_Pa = 6 * 101325, run.inputs.delivery.second_gauge_Pa = 0;
  wait(2);
  EXPECT_GT(balloons[1].pressure_Pa, 4 * 101325) << "and keeps its fill";
}

}  // namespace
}  // namespace ostium::app
