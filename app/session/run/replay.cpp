#include "app/session/run/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/session/scene/dose.h"
#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

RunSetup setup_of(const data::RecordingReader& recording) {
  RunSetup setup = setup_from_json(recording.path(), recording.setup());
  if (!setup.is_mesh()) return setup;
  const data::TableFile& tables = recording.tables();
  const std::vector<double> v = tables.numbers("mesh_vertices", 0, tables.rows("mesh_vertices"));
  const std::vector<std::uint64_t> t = tables.integers("mesh_triangles", 0, tables.rows("mesh_triangles"));
  for (std::size_t i = 0; i + 2 < v.size(); i += 3) setup.mesh.vertices.emplace_back(v[i], v[i + 1], v[i + 2]);
  for (std::size_t i = 0; i + 2 < t.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k)
      if (t[i + k] >= setup.mesh.vertices.size()) throw data::LoadError(recording.path() + ": its mesh is damaged");
    setup.mesh.triangles.push_back({static_cast<int>(t[i]), static_cast<int>(t[i + 1]), static_cast<int>(t[i + 2])});
  }
  return setup;
}

std::shared_ptr<const Vessel> vessel_for(const RunSetup& setup, std::shared_ptr<const Vessel> made) {
  std::string warnings;
  if (!made) made = make_vessel(setup, warnings);
  return made;
}

void require_same_layout(const data::RecordingReader& r, const SessionModel& model) {
  const auto width = static_cast<int>(state_count(model));
  if (r.input_columns() != input_names(model) || (r.states() && r.state_width() != width))
    throw data::LoadError(fmt::format(
        "{}: was written by another build of {}, whose state or inputs are laid out otherwise; replay it with that",
        r.path(), r.software()));
}

void require_same_step(const data::RecordingReader& r, const SessionModel& model) {
  if (r.step_s() != model.step_s())
    throw data::LoadError(
        fmt::format("{}: its step is {:g} s, and that of its run {:g} s; the file is damaged, copy it "
                    "again",
                    r.path(), r.step_s(), model.step_s()));
}

/// Adds the X-ray use of the steps from `from` to `to`.
void add_xrays(const data::RecordingReader& recording, const SessionModel& model, std::size_t from, std::size_t to,
               XrayUse& xrays) {
  constexpr std::size_t at_once = 10000;
  SessionInputs inputs;
  inputs.tools.resize(model.tools.size());
  const std::size_t width = core::count_fields(inputs);
  while (from < to) {
    const std::vector<double> rows = recording.inputs(from, std::min(at_once, to - from));
    for (std::size_t at = 0; at < rows.size(); at += width) {
      take_inputs(rows.data() + at, inputs);
      xrays.add(inputs.c_arm, ++from, recording.step_s());
    }
  }
}

}  // namespace

Replay::Replay(const std::string& file, std::shared_ptr<const Vessel> vessel)
    : recording(file),
      setup(setup_of(recording)),
      model(make_session(setup, vessel_for(setup, std::move(vessel)))),
      state(make_state(model, setup.seed)),
      scratch_(model) {
  require_same_layout(recording, model);
  require_same_step(recording, model);
  inputs.tools.resize(model.tools.size());
  look_at_inputs();
}

void Replay::look_at_inputs() {
  if (recording.steps() == 0) return;
  const std::size_t last = std::max<std::size_t>(state.rods.step, 1) - 1;
  take_inputs(recording.inputs(last, 1).data(), inputs);
}

void require_within(const data::RecordingReader& recording, double second) {
  if (!(second >= 0)) throw data::LoadError(fmt::format("--from {:g}: expected a second from 0 on", second));
  const double length_s = recording.step_s() * static_cast<double>(recording.steps());
  if (second > length_s)
    throw data::LoadError(fmt::format("--from {:g}: the recording is {:.3f} s long", second, length_s));
  if (recording.states() == 0 && second >= 1)
    throw data::LoadError(recording.path() + ": holds no states (--record events); replay it from 0");
}

void take_recorded_state(const data::RecordingReader& recording, const SessionModel& model, std::uint64_t seed,
                         std::size_t second, SessionState& state) {
  if (second == 0) {  // which no hash was made of
    state = make_state(model, seed);
    return;
  }
  take_state(recording.state(second).data(), state);
  const std::size_t step = second * data::steps_per_state;
  if (state.rods.step != step || recording.steps() < step || recording.hashes(step - 1, 1).front() != hash(state))
    throw data::LoadError(
        fmt::format("{}: its state at {:g} s is not the one that its hash was made of; the file is "
                    "damaged, replay it from 0",
                    recording.path(), recording.step_s() * static_cast<double>(step)));
}

void Replay::go_to(double second) {
  require_within(recording, second);
  if (recording.states() == 0) return;
  const double apart_s = recording.step_s() * data::steps_per_state;
  const std::size_t row = std::min(static_cast<std::size_t>(second / apart_s + 1e-9), recording.states() - 1);
  take_recorded_state(recording, model, setup.seed, row, state);
  look_at_inputs();
}

void Replay::read_ahead() {
  first_ = state.rods.step;
  const std::size_t count = std::min(ahead, recording.steps() - first_);
  rows_ = recording.inputs(first_, count);
  hashes_ = recording.hashes(first_, count);
}

bool Replay::tick() {
  const std::size_t now = state.rods.step;
  if (now >= recording.steps()) return false;
  if (now < first_ || now >= first_ + hashes_.size()) read_ahead();
  take_inputs(rows_.data() + (now - first_) * core::count_fields(inputs), inputs);
  step(model, inputs, state, scratch_, report);
  const core::InPhase phase(scratch_.rods.clock, hashing);
  same = hash(state) == hashes_[now - first_];
  return true;
}

const XrayUse& Replay::xrays() {
  if (xrays_to_ > state.rods.step) xrays_ = {}, xrays_to_ = 0;
  add_xrays(recording, model, xrays_to_, state.rods.step, xrays_);
  xrays_to_ = state.rods.step;
  return xrays_;
}

VerifyReport verify(Replay& replay, const std::function<void(const Replay&)>& progress) {
  VerifyReport out;
  while (replay.tick()) {
    const std::size_t done = replay.state.rods.step;
    ++out.steps;
    if (!replay.same && !out.first_step) out.first_step = done;
    if (progress && done % 100 == 0) progress(replay);
    if (!out.first_step || done % data::steps_per_state != 0) continue;
    const std::size_t row = done / data::steps_per_state;
    if (row >= replay.recording.states()) break;
    SessionState recorded = replay.state;
    take_state(replay.recording.state(row).data(), recorded);
    out.field = first_difference(replay.model, replay.state, recorded);
    out.field_step = done;
    break;
  }
  return out;
}

data::RunRecord record_of(const data::RecordingReader& recording, const SessionModel& model) {
  data::RunRecord record{.step_s = recording.step_s(),
                         .steps = recording.steps(),
                         .signal_columns = recording.signal_columns(),
                         .signals = recording.signals(),
                         .events = recording.events(),
                         .branches = {}};
  for (const vascular::TreeBranch& branch : model.vessel->way->branches()) record.branches.push_back(branch.name);
  XrayUse xrays;
  add_xrays(recording, model, 0, recording.steps(), xrays);
  if (!xrays.poses().empty()) Dosimeter(*model.vessel).measure(xrays, record);
  return record;
}

}  // namespace ostium::app
