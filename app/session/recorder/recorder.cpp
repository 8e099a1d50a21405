#include "app/session/recorder/recorder.h"

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "app/session/model/outcome.h"
#include "app/session/recorder/recording_header.h"
#include "core/base/thread_priority.h"
#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

using namespace std::chrono_literals;
constexpr std::size_t events_a_block = 2000;
constexpr double ffr_step = 0.005;

std::vector<double> flat(const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> out;
  for (const Eigen::Vector3d& p : points) out.insert(out.end(), {p.x(), p.y(), p.z()});
  return out;
}

}  // namespace

Recorder::Recorder(const RecorderOptions& options, const SessionModel& model, const RunSetup& setup,
                   std::size_t operator_count)
    : model_(model),
      options_(options),
      input_width_(input_count(model)),
      signal_width_(signal_count(model)),
      state_width_(state_count(model)),
      operator_width_(operator_count),
      shape_width_(shape_count(model)),
      slots_(slots),
      watch_(options.watch ? options.watch : std::make_shared<EventWatch>(model)),
      looked_at_(make_state(model, 0)) {
  const bool full = options.mode == RecordMode::full;
  const data::RecordingHeader header = header_of(model, setup, operator_count, full, options.shapes_Hz);
  if (options.mode != RecordMode::none) shape_every_ = static_cast<std::size_t>(header.steps_per_shape);
  for (Slot& slot : slots_) {
    slot.block.inputs.resize(data::steps_per_block * input_width_);
    slot.block.hashes.resize(data::steps_per_block);
    slot.block.signals.resize(data::steps_per_block / data::steps_per_signal * signal_width_);
    slot.block.states.resize(state_width_);  // one: a block is shorter than states are apart
    slot.block.hands.resize(operator_width_);
    slot.events.reserve(events_a_block);
    if (shape_every_ == 0) continue;
    const std::size_t most = data::steps_per_block / shape_every_ + 2;  // with the beginning
    slot.shapes_m.resize(most * shape_width_);
    slot.block.shape_steps.resize(most);
    slot.block.shape_inserted_m.resize(most * model.tools.size());
  }
  record_.step_s = model.step_s();
  // Reserves a quarter of an hour: unused memory costs nothing, while growing would briefly need it twice.
  record_.signals.reserve(static_cast<std::size_t>(900 / (model.step_s() * data::steps_per_signal)) * signal_width_);
  record_.signal_columns = header.signal_columns;
  record_.branches = header.branches;
  if (options.mode != RecordMode::none) {
    const std::vector<double> vertices = flat(setup.mesh.vertices);
    std::vector<std::uint64_t> triangles;
    for (const auto& t : setup.mesh.triangles)
      for (int v : t) triangles.push_back(static_cast<std::uint64_t>(v));
    std::vector<data::FixedTable> tables;
    if (setup.is_mesh())
      tables = {{{"mesh_vertices", data::NumberType::float64, {"x_m", "y_m", "z_m"}, 3, 4096},
                 vertices.data(),
                 vertices.size() / 3},
                {{"mesh_triangles", data::NumberType::uint64, {}, 3, 4096}, triangles.data(), triangles.size() / 3}};
    if (options.continues)
      writer_ = std::make_unique<data::RecordingWriter>(options.file, header, options.continues->file,
                                                        options.continues->steps);
    else
      writer_ = std::make_unique<data::RecordingWriter>(options.file, header, tables);
  }
  if (options.continues) take_before(*options.continues);
  thread_ = std::thread([this] { follow(); });
}

Recorder::~Recorder() {
  if (thread_.joinable()) {
    over_.store(true, std::memory_order_release);
    thread_.join();
  }
}

/// What has been recorded before is part of this run's record.
void Recorder::take_before(const Continued& before) {
  const data::RecordingReader reader(before.file);
  record_.steps = before.steps;
  const std::vector<double> signals =
      reader.tables().numbers("signals", 0, before.steps / static_cast<std::size_t>(data::steps_per_signal));
  record_.signals.assign(signals.begin(), signals.end());
  const std::vector<double> events = reader.events();
  for (std::size_t at = 0; at + 4 <= events.size() && events[at] <= static_cast<double>(before.steps); at += 4)
    record_.events.insert(record_.events.end(), events.begin() + static_cast<std::ptrdiff_t>(at),
                          events.begin() + static_cast<std::ptrdiff_t>(at + 4));
}

void Recorder::put_state(const SessionState& state, const OperatorState& hands) {
  Slot& slot = current();
  app::put_state(state, slot.block.states.data());
  core::put_fields(hands, slot.block.hands.data());
  slot.state_rows = 1;
}

void Recorder::put_shape(const SessionState& state) {
  if (shape_every_ == 0 || state.rods.step % shape_every_ != 0) return;
  Slot& slot = current();
  const std::size_t row = slot.shape_rows++;
  slot.block.shape_steps[row] = state.rods.step;
  put_shapes(model_, state, slot.shapes_m.data() + row * shape_width_,
             slot.block.shape_inserted_m.data() + row * model_.tools.size());
}

void Recorder::begin(const SessionState& state, const OperatorState& hands) {
  put_state(state, hands);
  put_shape(state);
}

void Recorder::add(const SessionInputs& inputs, const SessionState& state, const SessionReport& report,
                   const OperatorState& hands, const std::vector<OperatorEvent>& script) {
  {
    Slot& slot = current();
    put_inputs(inputs, slot.block.inputs.data() + slot.steps * input_width_);
    slot.block.hashes[slot.steps] = hash(state);
    ++slot.steps;
    if (state.rods.step % data::steps_per_signal == 0)
      put_signals(model_, state, inputs, report, slot.block.signals.data() + signal_width_ * slot.signal_rows++);
    put_shape(state);
    const std::size_t before = slot.events.size();
    if (before + 16 < events_a_block) watch_->look(model_, inputs, state, report, script, slot.events);
    if (options_.heard)
      for (std::size_t at = before; at < slot.events.size(); ++at) options_.heard(slot.events[at]);
    if (slot.steps == data::steps_per_block) hand_over();
  }
  if (state.rods.step % data::steps_per_state == 0) put_state(state, hands);
}

void Recorder::end(const SessionState& state, const std::vector<OperatorEvent>& script) {
  const std::size_t before = current().events.size();
  for (const OperatorEvent& e : script)
    current().events.push_back({state.rods.step, static_cast<int>(event_code(e.kind)), -1, 1.0 * e.step});
  if (options_.heard)
    for (std::size_t at = before; at < current().events.size(); ++at) options_.heard(current().events[at]);
}

void Recorder::hand_over() {
  const std::size_t next = filled_.load(std::memory_order_relaxed) + 1;
  filled_.store(next, std::memory_order_release);
  if (next - taken_.load(std::memory_order_acquire) >= slots) {
    ++waits_;
    while (next - taken_.load(std::memory_order_acquire) >= slots) std::this_thread::sleep_for(1ms);
  }
  Slot& slot = current();
  slot.steps = slot.signal_rows = slot.state_rows = slot.shape_rows = 0;
  slot.events.clear();
}

void Recorder::stop() {
  if (!thread_.joinable()) return;
  if (current().steps > 0 || current().state_rows > 0 || !current().events.empty()) hand_over();
  over_.store(true, std::memory_order_release);
  thread_.join();
}

void Recorder::finish(const std::string& end) {
  if (writer_ && problem_.empty()) writer_->finish(end);
}

void Recorder::follow() {
  core::give_way_to_steps();
  while (true) {
    const bool over = over_.load(std::memory_order_acquire);  // read before looking: no block is added after it
    const std::size_t next = taken_.load(std::memory_order_relaxed);
    if (next == filled_.load(std::memory_order_acquire)) {
      if (over) return;
      std::this_thread::sleep_for(5ms);
      continue;
    }
    take(slots_[next % slots]);
    taken_.store(next + 1, std::memory_order_release);
  }
}

/// Checks walls and flow of the slot's state: once a second, and too slow for the simulation thread.
void Recorder::look(const Slot& slot, std::vector<double>& events) {
  take_state(slot.block.states.data(), looked_at_);
  if (options_.penetration) app::add(app::penetration(model_, looked_at_), deepest_);
  if (!model_.has_patient() || model_.vessel->coronaries->lesions.empty()) return;
  const double ffr = ffr_behind_lesion(model_, looked_at_);
  if (std::fabs(ffr - ffr_) < ffr_step) return;
  ffr_ = ffr;
  // The state belongs to the beginning of the slot.
  events.insert(events.begin(), {static_cast<double>(looked_at_.rods.step),
                                 static_cast<double>(static_cast<int>(data::EventCode::ffr_changes)), -1, ffr});
}

/// Rows of all tools, parted by tool.
void Recorder::part_shapes(const Slot& slot, data::RecordingBlock& block) const {
  block.shapes_m.resize(model_.tools.size());
  for (std::size_t row = 0; row < slot.shape_rows; ++row) {
    const float* at = slot.shapes_m.data() + row * shape_width_;
    for (std::size_t t = 0; t < model_.tools.size(); ++t) {
      const std::size_t width = 3 * static_cast<std::size_t>(model_.rods.rods[t].nodes());
      block.shapes_m[t].insert(block.shapes_m[t].end(), at, at + width);
      at += width;
    }
  }
}

void Recorder::take(Slot& slot) {
  data::RecordingBlock block;
  const auto part = [](const auto& all, std::size_t count) {
    return std::decay_t<decltype(all)>(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
  };
  block.inputs = part(slot.block.inputs, slot.steps * input_width_);
  block.hashes = part(slot.block.hashes, slot.steps);
  block.signals = part(slot.block.signals, slot.signal_rows * signal_width_);
  block.states = part(slot.block.states, slot.state_rows * state_width_);
  block.hands = part(slot.block.hands, slot.state_rows * operator_width_);
  block.shape_steps = part(slot.block.shape_steps, slot.shape_rows);
  block.shape_inserted_m = part(slot.block.shape_inserted_m, slot.shape_rows * model_.tools.size());
  part_shapes(slot, block);
  for (const SessionEvent& e : slot.events)
    block.events.insert(block.events.end(), {static_cast<double>(e.step), static_cast<double>(e.code),
                                             static_cast<double>(e.tool), e.value});
  if (slot.state_rows) look(slot, block.events);
  record_.steps += slot.steps;
  record_.signals.insert(record_.signals.end(), block.signals.begin(), block.signals.end());
  record_.events.insert(record_.events.end(), block.events.begin(), block.events.end());
  if (!writer_ || !problem_.empty()) return;
  try {
    writer_->commit(std::move(block));
  } catch (const std::exception& error) {
    problem_ = error.what();
    if (options_.failed) options_.failed(problem_);
  }
}

}  // namespace ostium::app
