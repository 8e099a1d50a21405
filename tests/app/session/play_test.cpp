/// Pacing of a run in real time: short delays are caught up, long ones are dropped, pauses are neither.
#include "app/session/run/play.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "tests/app/session/tube_vessel.h"

namespace ostium::app {
namespace {

/// Delays the run once.
struct Dawdling : Driver {
  Dawdling(int ms, Driven after) : held(ms), then(after) {}
  Driven drive(const ScriptedRun& run, SessionInputs&) override {
    if (run.state.rods.step != 200) return Driven::on;
    std::this_thread::sleep_for(held);
    return then;
  }
  std::chrono::milliseconds held;
  Driven then;
};

struct Pace {
  double lost_s = 1e9, behind_most_ms = 1e9;
  long overruns = 0;
};

/// The best of five, since load on the machine only adds delay.
Pace pace_with(Dawdling slow) {
  Pace best;
  for (int i = 0; i < 5; ++i) {
    ScriptedRun run(tube_setup(), tube_vessel(), &slow);
    PlayOptions options;
    options.recorder.mode = RecordMode::none;
    options.recorder.penetration = false;
    options.real = true;
    options.seconds = 0.35;
    const PlayReport report = play(run, tube_setup(), options);
    best.lost_s = std::min(best.lost_s, report.clock_s - report.simulated_s);
    best.behind_most_ms = std::min(best.behind_most_ms, report.times.behind_most_ms);
    best.overruns = std::max(best.overruns, report.times.overruns);
  }
  return best;
}

TEST(Play, CatchesUpWithAHardStep) {
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "a sanitizer leaves a step no time to catch up in";
#endif
  const Pace hard = pace_with({30, Driven::on});
  EXPECT_GE(hard.behind_most_ms, 28);
  EXPECT_GE(hard.overruns, 2) << "the next ones began late, too";
  EXPECT_LT(hard.lost_s, 0.01);
}

TEST(Play, LetsALongStallGoInsteadOfRacingAfterIt) {
  const Pace stalled = pace_with({600, Driven::on});
  EXPECT_GE(stalled.behind_most_ms, 598);
  EXPECT_GE(stalled.lost_s, 0.59);
}

TEST(Play, CatchesUpAtMostTwiceAsFastAsTheClock) {
  const Pace slow = pace_with({200, Driven::on});  // 150 steps remain, of half a millisecond each
  EXPECT_GE(slow.lost_s, 0.12);
}

TEST(Play, AStandIsNotLate) {
  const Pace stood = pace_with({150, Driven::after_a_stand});
  EXPECT_GE(stood.lost_s, 0.14);
  EXPECT_LT(stood.behind_most_ms, 100);
}

}  // namespace
}  // namespace ostium::app
