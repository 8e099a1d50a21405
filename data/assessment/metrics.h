#pragma once
/// Metrics and events of a run: one table of definitions each. A metric is a pure function of the recording's signals
/// and events; adding one is a line in the table of metrics.cpp with its function, and a test.
#include <cstdint>
#include <string>
#include <vector>

namespace ostium {

enum class EventCode : int {
  script_step_begins,
  script_step_done,
  script_step_failed,
  script_step_timed_out,
  mark,
  tool_in,
  tool_out,
  tip_enters,
  wall_force_high,
  fluoroscopy_on,
  fluoroscopy_off,
  cine_on,
  cine_off,
  step_trouble,
  injection_begins,
  injection_ends,
  heparin,
  nitrate,
  adenosine,
  trace_changes,
  extrasystole,
  inflation_begins,
  deflated,
  over_pressure,
  balloon_burst,
  inflation_in_catheter,
  stent_deployed,
  stent_lost,
  occlusion_begins,
  occlusion_ends,
  injury,
  injection_on_bad_trace,
  entry_refused,
  ffr_changes,
  stent_elsewhere,
  // Handling, see app/session/handling.
  catheter_without_wire,
  wire_strays,
  wire_in_ventricle,
  thick_wire_in_coronary,
  push_without_advance,
  wound_up,
  tip_whips,
  deep_seat,
  bad_trace_kept,
  side_branch_pushed,
  blind_wire,
  wire_too_far,
  wire_drift,
  wire_position_lost,
  open_balloon_dragged,
  long_inflation,
  balloon_beyond_stent,
  idle_beam
};

/// Above this the sum of wall forces on a tool is an event. An estimate: no limit is agreed on; peak forces that
/// vascular phantoms report for novices are of this order.
inline constexpr double wall_force_limit_N = 1.0;
inline constexpr double wall_force_cut_off_Hz = 10;  ///< of the first-order low pass that forces are judged behind

/// So long a tip is in another branch of the tree before it counts as having come there, s.
inline constexpr double tip_settles_s = 0.3;

/// Flow behind the lesion below this share of what the muscle needs counts as none.
inline constexpr double occluded_share = 0.05;

/// Concentration over that of the undiluted, at which contrast counts as filling the ostium and as seen at the
/// landmark.
inline constexpr double filled_share = 0.5, seen_share = 0.15;

/// Of how tools are handled; what happens by itself, or is meant, is none.
enum class Severity { none, error, critical };

struct EventDefinition {
  EventCode code;
  std::string name;
  std::string definition;
  std::string value;  ///< what its value is, with the unit; empty: none
  Severity severity = Severity::none;
};
const std::vector<EventDefinition>& event_definitions();
const char* severity_name(Severity severity);  ///< "error"; of none: ""

/// A run as its recording has it.
struct RunRecord {
  double step_s = 1e-3;
  std::uint64_t steps = 0;
  std::vector<std::string> signal_columns;
  std::vector<double> signals;  ///< row by row
  std::vector<double> events;   ///< step, code, tool, value; row by row
  std::vector<std::string> branches;
  double kerma_Gy = 0, dose_area_Gy_m2 = 0;  ///< of all frames
  std::size_t rows() const { return signal_columns.empty() ? 0 : signals.size() / signal_columns.size(); }
};

struct Metric {
  std::string name;
  double value = 0;  ///< not a number: it does not apply
  std::string unit;
};

struct MetricDefinition {
  std::string name;  ///< snake case, with the unit last
  std::string unit;
  std::string definition;  ///< which includes the clock
  double (*of)(const RunRecord&);
};
const std::vector<MetricDefinition>& metric_definitions();

/// All of the table, in its order.
std::vector<Metric> metrics_of(const RunRecord& record);

/// metrics.json (data/schemas/metrics.schema.json).
std::string metrics_json(const std::string& case_name, std::uint64_t seed, const std::string& outcome,
                         const std::string& reason, const std::vector<Metric>& metrics);

}  // namespace ostium
