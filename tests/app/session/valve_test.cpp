/// The aortic valve in a session: a wire pushed against it enters the ventricle and causes extrasystoles; a guide stops
/// at it.
#include <gtest/gtest.h>

#include "app/session/model/penetration.h"
#include "app/session/model/session.h"
#include "data/catalogue/catalogue.h"
#include "vascular/motion/heart_cycle.h"
#include "vascular/motion/heart_motion.h"

namespace ostium::app {
namespace {

using Eigen::Vector3d;

/// Instruments that come straight down onto the valve from 30 mm above it.
struct AboveTheValve {
  std::shared_ptr<const Vessel> vessel = vessel_of(data::find_case("rca-mid-focal"), std::nullopt);
  SessionModel model;
  SessionState state;
  std::optional<SessionScratch> scratch;
  SessionInputs inputs;
  SessionReport report;
  int ectopics = 0, troubled = 0;

  explicit AboveTheValve(const char* instrument) {
    model = make_session(vessel, {{"tool", data::find_instrument(data::load_catalogue(), instrument), ""}});
    const vascular::Landmarks& marks = vessel->patient->anatomy.landmarks;
    model.entry = end_at(marks.p_annulus + 0.030 * marks.root_axis, -marks.root_axis);
    state = make_state(model, 0);
    scratch.emplace(model);
    inputs.tools.resize(1);
  }
  void run(double mm_s, double seconds) {
    inputs.tools[0].feed_m_s = 1e-3 * mm_s;
    for (int n = 0; n < 1000 * seconds; ++n) {
      const bool before = state.blood.heart.ectopic;
      step(model, inputs, state, *scratch, report);
      ectopics += state.blood.heart.ectopic > before;
      troubled += (report.rods.trouble & ~static_cast<std::uint32_t>(core::feed_stopped)) != 0;
    }
  }
  /// Height of the tip along the root's axis.
  double above_annulus_m() const {
    const vascular::Landmarks& marks = vessel->patient->anatomy.landmarks;
    const Vector3d shift =
        vascular::contraction(state.blood.heart.phase) * vascular::HeartMotion(marks).root_displacement();
    return (tip(model, state, 0) - shift - marks.p_annulus).dot(marks.root_axis);
  }
  std::string branch() const {
    return vessel->way
        ->branches()[static_cast<std::size_t>(vessel->way->branch(vessel->way->locate(tip(model, state, 0), 0.7)))]
        .name;
  }
};

TEST(Valve, AWireGoesThroughItIntoTheVentricleAndGivesExtrasystoles) {
  AboveTheValve root("cook-straight");
  root.run(40, 2);
  EXPECT_LT(root.above_annulus_m(), -20e-3);
  EXPECT_EQ(root.state.coupling.through_valve, 1);
  root.run(40, 1.3);
  EXPECT_EQ(root.branch(), "left ventricle");
  root.run(0, 10);
  EXPECT_GT(root.ectopics, 2);
  const Penetration depth = penetration(root.model, root.state);
  EXPECT_LT(depth.deepest_m, 0.05e-3);
  EXPECT_EQ(depth.outside, 0);
  // Once withdrawn it no longer irritates the ventricle.
  root.run(-60, 2.1);
  EXPECT_GT(root.above_annulus_m(), 5e-3);
  root.run(0, 2);
  EXPECT_EQ(root.state.coupling.through_valve, 0);
  const int before = root.ectopics;
  root.run(0, 5);
  EXPECT_EQ(root.ectopics, before);
  EXPECT_LE(root.troubled, 3);
}

TEST(Valve, AGuideStandsOnIt) {
  AboveTheValve root("guide-jr4-6f");
  double lowest = 1;
  for (int n = 0; n < 60; ++n) root.run(30, 0.05), lowest = std::min(lowest, root.above_annulus_m());
  EXPECT_GT(lowest, -1.5e-3);
  EXPECT_EQ(root.state.coupling.through_valve, 0);
  EXPECT_EQ(root.ectopics, 0);
  EXPECT_LT(penetration(root.model, root.state).deepest_m, 0.05e-3);
}

}  // namespace
}  // namespace ostium::app
