/// Guides in the aortic root: JR4 and JL4 must engage the ostia as they do in people, and Amplatz must move as it does.
/// Runs the scripts of data/scripts in a full session; turns in the wrong direction must fail.
#include <algorithm>
#include <cmath>

#include "app/gates/gate.h"
#include "app/session/run/run.h"
#include "core/base/units.h"

namespace ostium::app::gates {

namespace {

using units::per_mm, units::degree;
constexpr int people = 10;
constexpr int hands = 3;  // seeds of the operator

/// What a guide did between two steps of a script.
struct Manoeuvre {
  bool done = false;  ///< the script went on after it rather than back
  double fed_m = 0, turned_rad = 0;
};

int step_named(const data::Script& script, const std::string& label) {
  for (std::size_t s = 0; s < script.steps.size(); ++s)
    if (script.steps[s].label == label) return static_cast<int>(s);
  return -1;
}

RunSetup setup_of(const std::string& script, int person) {
  RunSetup setup;
  set_vessel("rca-mid-focal", {}, setup);
  set_script(data::find_script(script), setup);
  set_value("person", std::to_string(person), setup);
  return setup;
}

/// Of the case, whatever the script.
std::shared_ptr<const Vessel> vessel_of_person(int person) {
  std::string warnings;
  return make_vessel(setup_of("jr4-engages-rca", person), warnings);
}

/// Runs until step `s` begins; false if the script fails before.
bool run_to(int s, ScriptedRun& run) {
  while (static_cast<int>(run.hands.step) != s)
    if (!run.tick()) return false;
  return true;
}

/// Runs steps `first` to `last` once.
Manoeuvre run_steps(int first, int last, ScriptedRun& run) {
  Manoeuvre out;
  const double fed = run.state.hands[0].fed_m, turned = run.state.hands[0].turned_rad;
  int s = first;
  while (s >= first && s <= last && run.tick()) {
    out.fed_m = run.state.hands[0].fed_m - fed, out.turned_rad = run.state.hands[0].turned_rad - turned;
    s = static_cast<int>(run.hands.step);
  }
  out.done = s == last + 1;
  return out;
}

/// Whether the guide's tip is still in the branch when the script ends.
bool stays(ScriptedRun& run) {
  while (run.tick()) {
  }
  return run.outcome == Outcome::success;
}

struct Counted {
  int clockwise = 0, counter_clockwise = 0;
};

/// Continues a copy of the run with 20 mm of withdrawal and 135 degrees counter-clockwise; true if the tip then stays
/// in the RCA for three beats.
bool engages_counter_clockwise(const ScriptedRun& at) {
  const SessionModel& model = at.model;
  const VesselIndex& way = *model.vessel->way;
  const int artery = way.entry("RCA");
  SessionState state = at.state;
  SessionScratch scratch(model);
  SessionReport report;
  SessionInputs hand = at.inputs;
  for (ToolInputs& tool : hand.tools) tool = {};
  constexpr int turning = 4500, holding = 2600;
  bool in_artery = true;
  for (int n = 0; n < turning + holding; ++n) {
    hand.tools[0] = n < turning ? ToolInputs{-20e-3 / 4.5, -30 * degree} : ToolInputs{};
    step(model, hand, state, scratch, report);
    if (n >= turning) in_artery &= way.beyond(way.locate(tip(model, state, 0), state.blood.heart.phase), artery);
  }
  return in_artery;
}

/// JR4 starting at the valve: turned clockwise while drawn back, and from the same state counter-clockwise.
Counted judkins_right(int person, const std::shared_ptr<const Vessel>& vessel) {
  const RunSetup setup = setup_of("jr4-engages-rca", person);
  const int turn = step_named(setup.script, "clockwise"), back = step_named(setup.script, "drawn back");
  ScriptedRun run(setup, vessel);
  if (!run_to(turn, run)) return {};
  Counted out;
  out.counter_clockwise = engages_counter_clockwise(run);
  const Manoeuvre m = run_steps(turn, back, run);
  const bool as_asked = -per_mm * m.fed_m <= 30 && m.turned_rad / degree <= 180;
  out.clockwise = m.done && as_asked && stays(run);
  return out;
}

int judkins_left(int person, const std::shared_ptr<const Vessel>& vessel) {
  const RunSetup setup = setup_of("jl4-engages-lm", person);
  ScriptedRun run(setup, vessel);
  return stays(run);
}

/// How far the guide's tip is in the left main, along it, m: averaged over a beat, since the root moves by more than
/// that. Advances `run` by that beat.
double depth_in_left_main(ScriptedRun& run) {
  const VesselIndex& way = *run.model.vessel->way;
  const int ostium = way.place("LM"), further = way.place("LM+6");
  const double beat_s = 60 / run.model.vessel->rate_1_min, begin_s = seconds(run.model, run.state);
  double sum = 0;
  int count = 0;
  while (seconds(run.model, run.state) < begin_s + beat_s && run.tick()) {
    const double phase = run.state.blood.heart.phase;
    const Eigen::Vector3d p_ostium = way.p(ostium, phase);
    sum += (tip(run.model, run.state, 0) - p_ostium).dot((way.p(further, phase) - p_ostium).normalized());
    ++count;
  }
  return sum / count;
}

/// An Amplatz in the left main, its curve on the valve: how much deeper its tip goes when the guide is drawn back by 10
/// mm, m. This depends on how it was placed, so it differs between seeds.
double amplatz_drawn_back(std::uint64_t seed, const std::shared_ptr<const Vessel>& vessel) {
  RunSetup setup = setup_of("al1-engages-lm", 0);
  setup.seed = seed;
  const int settles = step_named(setup.script, "it settles"), back = step_named(setup.script, "drawn back");
  ScriptedRun run(setup, vessel);
  if (!run_to(settles, run)) return -1;
  depth_in_left_main(run);
  const double before = depth_in_left_main(run);
  if (!run_to(back, run)) return -1;
  double deepest = -1;
  for (int beat = 0; beat < 2; ++beat) deepest = std::max(deepest, depth_in_left_main(run));
  return deepest - before;
}

}  // namespace

std::vector<data::GateResult> engagement(bool quick) {
  const int n = quick ? 1 : people;
  Counted right;
  int left = 0;
  for (int person = 1; person <= n; ++person) {
    const std::shared_ptr<const Vessel> vessel = vessel_of_person(person);
    const Counted r = judkins_right(person, vessel);
    right.clockwise += r.clockwise, right.counter_clockwise += r.counter_clockwise;
    left += judkins_left(person, vessel);
  }
  double deeper_m = 0;
  const std::shared_ptr<const Vessel> mean = vessel_of_person(0);
  for (int seed = 0; seed < hands; ++seed)
    deeper_m += amplatz_drawn_back(static_cast<std::uint64_t>(seed), mean) / hands;
  const double tenths = n;
  return {{"engagement-jr4-clockwise", right.clockwise / tenths, 1, 0.2, ""},
          {"engagement-jr4-counter-clockwise", right.counter_clockwise / tenths, 0, 0, ""},
          {"engagement-jl4-no-turn", left / tenths, 1, 0.2, ""},
          {"engagement-al1-drawn-back-deeper", per_mm * deeper_m, 0.6, 0.5, "mm"}};
}

}  // namespace ostium::app::gates
