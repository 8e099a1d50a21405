#include "app/session/run/branch.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/session/run/replay.h"
#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

/// X-ray use, and when each tool was moved, until a step, from the recorded inputs.
void count_until(const data::RecordingReader& recording, std::size_t steps, ScriptedRun& run) {
  constexpr std::size_t at_once = 10000;
  SessionInputs inputs = run.inputs;
  const std::size_t width = core::count_fields(inputs);
  run.xrays = {};
  std::ranges::fill(run.moved_at, 0);
  for (std::size_t from = 0; from < steps;) {
    const std::vector<double> rows = recording.inputs(from, std::min(at_once, steps - from));
    for (std::size_t at = 0; at < rows.size(); at += width) {
      take_inputs(rows.data() + at, inputs);
      run.xrays.add(inputs.c_arm, ++from, recording.step_s());
      note_moved(inputs, from, run.moved_at);
    }
  }
}

}  // namespace

std::shared_ptr<EventWatch> go_back(ScriptedRun& run, const Continued& to) {
  const data::RecordingReader recording(to.file);
  constexpr auto second = static_cast<std::size_t>(data::steps_per_state);
  const std::size_t row = to.steps / second, before = row > 0 ? row - 1 : 0;
  const std::size_t width = input_count(run.model);
  if (to.steps % second != 0 || recording.states() <= row || recording.steps() < to.steps ||
      recording.input_columns() != input_names(run.model) ||
      recording.state_width() != static_cast<int>(state_count(run.model)))
    throw data::LoadError(fmt::format("{}: has no state at {} s; expected a whole second of this run's recording",
                                      to.file, to.steps / second));
  run.report = {};
  take_recorded_state(recording, run.model, setup_from_json(recording.path(), recording.setup()).seed, before,
                      run.state);
  count_until(recording, before * second, run);
  auto watch = std::make_shared<EventWatch>(run.model);
  std::vector<SessionEvent> seen;
  const std::vector<double> rows = recording.inputs(before * second, to.steps - before * second);
  SessionInputs inputs = run.inputs;
  for (std::size_t at = 0; at < rows.size(); at += width) {
    take_inputs(rows.data() + at, inputs);
    run.repeat(inputs);
    watch->look(run.model, run.inputs, run.state, run.report, run.events, seen);
    seen.clear();
  }
  if (to.steps > 0 && hash(run.state) != recording.hashes(to.steps - 1, 1).front())
    throw data::LoadError(fmt::format("{}: is another at {} s than its hash says; the file is damaged", to.file, row));
  restore(recording.tables().numbers("hands", row, 1), run.hands);
  run.outcome = run.hands.outcome = Outcome::running;
  run.stood = false;
  return watch;
}

}  // namespace ostium::app
