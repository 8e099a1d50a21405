#pragma once
/// A run as read from its recording, for metrics and pages.
#include <cstdint>
#include <string>
#include <vector>

#include "data/assessment/events.h"

namespace ostium::data {

struct RunRecord {
  double step_s = 1e-3;
  std::uint64_t steps = 0;
  std::vector<std::string> signal_columns;  ///< "time_s" is the first; a tool's are called "wire.push_N"
  std::vector<double> signals;              ///< row by row
  std::vector<double> events;               ///< step, code, tool, value; row by row
  std::vector<std::string> branches;
  double kerma_Gy = 0, dose_area_Gy_m2 = 0;  ///< of all frames
  std::size_t rows() const { return signal_columns.empty() ? 0 : signals.size() / signal_columns.size(); }
};

struct RecordedEvent {
  double step = 0, time_s = 0;
  EventCode code{};
  int tool = -1;  ///< -1: none
  double value = 0;
};
std::vector<RecordedEvent> events_of(const RunRecord& record);
std::vector<RecordedEvent> events_of(const RunRecord& record, EventCode code);

/// One signal over the run.
struct SignalColumn {
  const RunRecord& record;
  std::size_t at;
  double operator[](std::size_t row) const { return record.signals[row * record.signal_columns.size() + at]; }
};

/// A signal of tools, "push_N": that of each tool that has it.
std::vector<SignalColumn> tool_columns(const RunRecord& record, const std::string& signal);

/// Time between two rows, s.
double row_spacing_s(const RunRecord& record);

// For signals that do not belong to a tool. Values that the recording lacks are NaN.
std::vector<double> all_of(const RunRecord& record, const std::string& signal);  ///< empty: no such signal
double first_of(const RunRecord& record, const std::string& signal);
double last_of(const RunRecord& record, const std::string& signal);

}  // namespace ostium::data
