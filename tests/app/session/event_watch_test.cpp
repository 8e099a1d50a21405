/// What counts as an event, on a run that stands still.
#include "app/session/recorder/event_watch.h"

#include <gtest/gtest.h>

#include "app/session/run/run.h"
#include "tests/app/session/short_treatment.h"

namespace ostium::app {
namespace {

struct Watched {
  ScriptedRun run{setup(), vessel()};
  EventWatch watch{run.model};
  std::vector<SessionEvent> events;

  Watched() {
    EXPECT_TRUE(run.tick());
    look();
  }
  void look() {
    events.clear();
    watch.look(run.model, run.inputs, run.state, run.report, {}, events);
  }
  std::vector<double> values(data::EventCode code) const {
    std::vector<double> out;
    for (const SessionEvent& e : events)
      if (e.code == static_cast<int>(code)) out.push_back(e.value);
    return out;
  }
};

TEST(EventWatch, APerforationIsACriticalErrorAndADissectionIsNone) {
  Watched w;
  const auto told = [&](vascular::InjuryKind kind, int grade) {
    w.run.state.treatment.injury.injuries[0] = {.kind = kind, .cell = 5, .grade = grade};
    w.look();
    return w.values(data::EventCode::perforation);
  };
  EXPECT_EQ(data::definition_of(data::EventCode::perforation)->severity, data::Severity::critical);
  EXPECT_EQ(told(vascular::InjuryKind::dissection, 1), std::vector<double>{});
  EXPECT_EQ(w.values(data::EventCode::injury), std::vector<double>{11});
  EXPECT_EQ(told(vascular::InjuryKind::perforation, 1), std::vector<double>{1});
  EXPECT_EQ(w.values(data::EventCode::injury), std::vector<double>{21});
  EXPECT_EQ(told(vascular::InjuryKind::perforation, 1), std::vector<double>{}) << "once";
  EXPECT_EQ(told(vascular::InjuryKind::perforation, 3), std::vector<double>{3}) << "it gets worse";
}

TEST(EventWatch, AWallThatEachBeatPressesIsPressedOnce) {
  Watched w;
  const auto times = [&](double N, double time_s) {
    std::size_t count = 0;
    w.run.report.tools[0].wall_force_N = N;
    for (int n = 0; n * w.run.model.step_s() < time_s; ++n) {
      w.look();
      count += w.values(data::EventCode::wall_force_high).size();
    }
    return count;
  };
  EXPECT_EQ(times(2, 0.3), 1u);
  for (int beat = 0; beat < 4; ++beat) EXPECT_EQ(times(0, 0.6) + times(2, 0.3), 0u) << "beat " << beat;
  EXPECT_EQ(times(0, 2.5) + times(2, 0.3), 1u) << "it had been let go";
}

TEST(EventWatch, AHoleThatBleedsInSystoleLeaksOnce) {
  Watched w;
  w.run.state.treatment.injury.injuries[0] = {.kind = vascular::InjuryKind::perforation, .cell = 5, .grade = 3};
  std::size_t stops = 0, again = 0;
  const auto leak = [&](double mL_s, double time_s) {
    w.run.state.treatment.injury.injuries[0].leak_m3_s = 1e-6 * mL_s;
    const auto steps = static_cast<std::uint64_t>(time_s / w.run.model.step_s());
    for (std::uint64_t n = 0; n < steps; ++n) {
      ++w.run.state.rods.step;
      w.look();
      stops += w.values(data::EventCode::leak_stops).size(), again += w.values(data::EventCode::leak_goes_on).size();
    }
  };
  for (int beat = 0; beat < 5; ++beat) leak(0.1, 0.25), leak(0, 0.2);
  EXPECT_EQ(stops + again, 0u);
  leak(0, 2);
  EXPECT_EQ(stops, 1u);
  leak(0.1, 0.2);
  EXPECT_EQ(again, 1u) << "it had stopped";
}

}  // namespace
}  // namespace ostium::app
