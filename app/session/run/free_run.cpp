#include "app/session/run/free_run.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/session/recorder/signals.h"
#include "core/rod/introducer.h"

namespace ostium::app {

// --- what runs share -------------------------------------------------------------------------------------------------

FreeRunModel::FreeRunModel(SessionModel model, std::uint64_t of_beginning)
    : session(std::move(model)),
      seed(of_beginning),
      at_rest(inputs_at_rest(session)),
      input_names(app::input_names(session)),
      signal_names(app::signal_names(session)),
      ranges(input_ranges(session)),
      state_count_(core::count_fields(make_state(session, 0))) {}

SessionState FreeRunModel::beginning(std::uint64_t of_seed) const { return make_state(session, of_seed); }

FreeRunModel::Borrowed::Borrowed(const FreeRunModel& from, int preferred) : from_(from) {
  {
    const std::lock_guard lock(from.mutex_);
    auto& all = from.scratches_;
    const auto is_free = [&](int k) { return k >= 0 && k < static_cast<int>(all.size()) && all[k]; };
    number_ = is_free(preferred) ? preferred : 0;
    while (number_ < static_cast<int>(all.size()) && !all[number_]) ++number_;
    if (number_ == static_cast<int>(all.size())) all.emplace_back();
    scratch_ = std::move(all[number_]);
  }
  if (!scratch_) scratch_ = std::make_unique<SessionScratch>(from.session, WallCopy::when_it_opens);
}

FreeRunModel::Borrowed::~Borrowed() {
  const std::lock_guard lock(from_.mutex_);
  from_.scratches_[number_] = std::move(scratch_);
}

// --- a run -----------------------------------------------------------------------------------------------------------

FreeRun::FreeRun(std::shared_ptr<const FreeRunModel> of)
    : model(std::move(of)),
      state(model->beginning(model->seed)),
      row(model->input_names.size()),
      signals(model->signal_names.size()),
      forces(model->session.tools.size()),
      peaks(forces.size()),
      inputs_(model->at_rest) {
  put_inputs(inputs_, row.data());
  look();
}

FreeRun::FreeRun(const FreeRun& other)
    : model(other.model),
      state(other.state),
      row(other.row),
      signals(other.signals),
      forces(other.forces),
      peaks(other.peaks),
      trouble(other.trouble),
      deepest_m(other.deepest_m),
      inputs_(other.inputs_),
      report_(other.report_) {}

void FreeRun::reset(std::uint64_t seed) {
  const SessionState fresh = model->beginning(seed);
  state = fresh;  // copied into the same memory, which others may look at
  inputs_ = model->at_rest;
  put_inputs(inputs_, row.data());
  report_ = {};
  trouble = 0, deepest_m = 0;
  look();
}

void FreeRun::set_state(const double* numbers) {
  take_state(numbers, state);
  report_ = {};
  trouble = 0, deepest_m = 0;
  look();
}

/// Signals and forces of this moment; before the first step there is no report yet.
void FreeRun::look() {
  report_.tools.resize(forces.size());
  if (report_.rods.rods.empty())
    for (std::size_t t = 0; t < forces.size(); ++t)
      report_.tools[t] = {.in_body = in_body(model->session.rods.rods[t], state.rods.rods[t])};
  for (std::size_t t = 0; t < forces.size(); ++t) {
    const ToolReport& of = report_.tools[t];
    forces[t] = {of.push_N, of.torque_Nm, of.wall_force_N, of.tip_force_N};
  }
  put_signals(model->session, state, inputs_, report_, signals.data());
}

void FreeRun::step(int count, const std::function<bool()>& stop) {
  const std::string wrong = first_out_of_range(model->input_names, model->ranges, row.data());
  if (!wrong.empty()) throw std::invalid_argument(wrong);
  take_inputs(row.data(), inputs_);
  std::fill(peaks.begin(), peaks.end(), ToolForces{});
  trouble = 0, deepest_m = 0;
  FreeRunModel::Borrowed borrowed(*model, scratch_);
  scratch_ = borrowed.number();
  for (int i = 0; i < count; ++i) {
    if (stop && i > 0 && i % steps_unasked == 0 && stop()) break;
    app::step(model->session, inputs_, state, borrowed.scratch(), report_);
    forget_what_is_given_once(inputs_.delivery);
    trouble |= report_.rods.trouble;
    deepest_m = std::max(deepest_m, report_.rods.deepest_m);
    for (std::size_t t = 0; t < peaks.size(); ++t) {
      const ToolReport& of = report_.tools[t];
      const auto raise = [](double& most, double to) { most = std::max(most, std::fabs(to)); };
      raise(peaks[t].push_N, of.push_N), raise(peaks[t].torque_Nm, of.torque_Nm);
      raise(peaks[t].wall_N, of.wall_force_N), raise(peaks[t].tip_N, of.tip_force_N);
    }
  }
  look();
}

}  // namespace ostium::app
