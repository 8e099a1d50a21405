/// A whole run over USB: a scripted hand moves wire and guide in an emulated box, libusb delivers the counts, the
/// session follows; the recording replays without any of these.
#include <gtest/gtest.h>

#include <filesystem>

#include "app/session/device/emulated_box_driver.h"
#include "app/session/run/play.h"
#include "app/session/run/replay.h"
#include "device/transport/usb_port.h"
#include "tests/integration/usb/bench.h"

namespace ostium::test {
namespace {

/// A run at a box on the bench, one step per sample.
struct RunAtBench {
  device::UsbPort port;
  device::TrackingBox host{port, {}};
  app::EmulatedBoxDriver fingers;
  bool stepping = false;
  double most_clamp_N = 0, most_in_box_m = 0;
  app::BoxDriver hand{{}, [this](const device::BoxRequest& request) -> const device::BoxSnapshot& {
                        const std::uint64_t before = host.now().reports;
                        for (int i = 0; i < 1000 && host.now().reports == before; ++i) {
                          bench().step();
                          host.poll(0.01, request);
                        }
                        const device::BoxSnapshot& now = host.now();
                        EXPECT_GT(now.reports, before);
                        EXPECT_EQ(now.link, device::Link::running) << advice(now);
                        bench().usb.with([&](device::EmulatedBox&, device::EmulatedFaults&) { fingers.see(now); });
                        for (const device::ToolSnapshot& tool : now.tool) {
                          most_clamp_N = std::max(most_clamp_N, tool.clamp_N);
                          most_in_box_m = std::max(most_in_box_m, tool.in_box_m);
                        }
                        return now;
                      }};
  app::EmulatedOperator scripted{hand, fingers};

  RunAtBench() {
    bench().set_pace(Bench::Pace::stepped);
    bench().usb.set_hand([this](device::EmulatedBox& box) { fingers.move(box); });
    bench().plug();
  }
  ~RunAtBench() {
    bench().unplug();
    bench().usb.with([](device::EmulatedBox& box, device::EmulatedFaults&) { box.station = {}; });
    bench().usb.set_hand({});
  }
};

TEST(UsbSession, WireAndGuideReachTheAorticRootInStrokesAndReplayWithoutTheDevice) {
  app::RunSetup setup;
  set_vessel("rca-mid-focal", vascular::LengthUnit::millimetre, setup);
  data::Script script = data::find_script("jr4-engages-rca");
  while (script.steps.back().label != "wire out") script.steps.pop_back();
  set_script(script, setup);
  setup.hand_speed = 3;
  std::string warnings;
  const auto vessel = make_vessel(setup, warnings);
  const std::string file = testing::TempDir() + "usb_session.h5";
  app::PlayReport report;
  {
    RunAtBench at;
    app::ScriptedRun run(setup, vessel, &at.scripted);
    app::PlayOptions options;
    options.recorder.file = file;
    options.recorder.penetration = false;
    report = play(run, setup, options);
    EXPECT_EQ(report.outcome, "success") << report.reason;
    const int sinuses = run.model.vessel->way->place("sinuses");
    const int ascending = run.model.vessel->way->place("ascending aorta");
    const int guide = run.model.vessel->way->locate(tip(run.model, run.state, 0), run.state.blood.heart.phase);
    EXPECT_TRUE(run.model.vessel->way->beyond(guide, ascending)) << "the guide's tip is in the root";
    EXPECT_GE(sinuses, 0);
    EXPECT_GE(at.hand.stood(), 5) << "750 mm of each in strokes of 30 cm";
    EXPECT_EQ(at.fingers.drawn_back(), at.hand.stood());
    EXPECT_LE(at.most_in_box_m, 0.301);
    EXPECT_EQ(at.host.now().lost, 0u);
    EXPECT_EQ(at.host.now().ignored, 0u);
    EXPECT_GT(at.most_clamp_N, 0.3) << "forces come back";
    for (std::size_t t = 0; t < 2; ++t)
      EXPECT_NEAR(run.state.rods.rods[t].inserted_m, std::max(0.0, at.host.now().tool[t].inserted_m), 8e-3)
          << "hand and instrument agree, but for 15 ms of a hand that moves at 0.45 m/s as the script ends";
    std::printf("%s: %.1f s simulated, %ld strokes drawn back, %llu reports, clamps up to %.2f N\n",
                bench().name().c_str(), report.simulated_s, at.fingers.drawn_back(),
                static_cast<unsigned long long>(at.host.now().reports), at.most_clamp_N);
  }
  ASSERT_EQ(report.problem, "");
  app::Replay replay(file, vessel);
  const app::VerifyReport verified = verify(replay);
  EXPECT_EQ(verified.steps, static_cast<std::size_t>(std::lround(1000 * report.simulated_s)));
  EXPECT_FALSE(verified.first_step);
  EXPECT_EQ(hash(replay.state), report.hash);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace ostium::test
