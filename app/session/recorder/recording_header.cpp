#include "app/session/recorder/recording_header.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/session/recorder/signals.h"
#include "core/rod/introducer.h"
#include "data/assessment/events.h"

namespace ostium::app {

namespace {

std::vector<data::TableAttribute> of_events() {
  std::vector<std::string> names, severities, values, definitions;
  for (const data::EventDefinition& event : data::event_definitions()) {
    names.push_back(event.name), severities.emplace_back(severity_name(event.severity));
    values.push_back(event.value), definitions.push_back(event.definition);
  }
  return {{"names", names}, {"severities", severities}, {"values", values}, {"definitions", definitions}};
}

}  // namespace

data::RecordingHeader header_of(const SessionModel& model, const RunSetup& setup, std::size_t operator_count, bool full,
                                double shapes_Hz) {
  data::RecordingHeader header{.software = "ostium " OSTIUM_VERSION,
                               .setup = to_json(setup),
                               .step_s = model.step_s(),
                               .full = full,
                               .input_columns = input_names(model),
                               .signal_columns = signal_names(model),
                               .state_width = static_cast<int>(state_count(model)),
                               .operator_width = static_cast<int>(operator_count)};
  for (const std::string& input : header.input_columns) header.input_units.push_back(data::unit_in_name(input));
  for (const SignalDefinition& signal : signal_definitions(model)) {
    header.signal_units.push_back(signal.unit);
    header.signal_definitions.push_back(signal.definition);
  }
  for (const SessionTool& tool : model.tools) header.tools.push_back(tool.name);
  for (const vascular::TreeBranch& branch : model.vessel->way->branches()) header.branches.push_back(branch.name);
  for (const data::ScriptStep& step : setup.script.steps)
    header.script_steps.push_back(step.words() + (step.text.empty() ? "" : ": " + step.text));
  header.frame =
      setup.is_mesh() ? "the mesh's, in m" : "the patient's, in m: x to the left, y to the head, z to the front";
  header.of_events = of_events();
  if (shapes_Hz <= 0) return header;
  header.steps_per_shape = std::max(1, static_cast<int>(std::lround(1 / (shapes_Hz * model.step_s()))));
  for (std::size_t t = 0; t < model.tools.size(); ++t)
    header.shapes.push_back({model.tools[t].name, model.rods.rods[t].node_from_tip_m});
  return header;
}

std::size_t shape_count(const SessionModel& model) {
  std::size_t count = 0;
  for (const core::Rod& rod : model.rods.rods) count += 3 * static_cast<std::size_t>(rod.nodes());
  return count;
}

void put_shapes(const SessionModel& model, const SessionState& state, float* row, double* inserted_m) {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t t = 0; t < model.rods.rods.size(); ++t) {
    const core::Rod& rod = model.rods.rods[t];
    const core::RodState& own = state.rods.rods[t];
    const int first = in_body(rod, own) ? own.first : rod.nodes();
    inserted_m[t] = own.inserted_m;
    for (int i = 0; i < rod.nodes(); ++i)
      for (int c = 0; c < 3; ++c) *row++ = i < first ? none : static_cast<float>(own.position.at(c)[i]);
  }
}

}  // namespace ostium::app
