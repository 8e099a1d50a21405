#include "data/assessment/run_record.h"

#include <limits>

namespace ostium::data {

std::vector<RecordedEvent> events_of(const RunRecord& record) {
  std::vector<RecordedEvent> out;
  for (std::size_t e = 0; e + 3 < record.events.size(); e += 4)
    out.push_back({.step = record.events[e],
                   .time_s = record.events[e] * record.step_s,
                   .code = static_cast<EventCode>(static_cast<int>(record.events[e + 1])),
                   .tool = static_cast<int>(record.events[e + 2]),
                   .value = record.events[e + 3]});
  return out;
}

std::vector<RecordedEvent> events_of(const RunRecord& record, EventCode code) {
  std::vector<RecordedEvent> out = events_of(record);
  std::erase_if(out, [&](const RecordedEvent& e) { return e.code != code; });
  return out;
}

std::vector<SignalColumn> tool_columns(const RunRecord& record, const std::string& signal) {
  std::vector<SignalColumn> out;
  for (std::size_t c = 0; c < record.signal_columns.size(); ++c)
    if (record.signal_columns[c].ends_with("." + signal)) out.push_back({record, c});
  return out;
}

double row_spacing_s(const RunRecord& record) {
  return record.rows() > 1 ? record.signals[record.signal_columns.size()] - record.signals[0] : 0;
}

std::vector<double> all_of(const RunRecord& record, const std::string& signal) {
  std::vector<double> out;
  for (std::size_t c = 0; c < record.signal_columns.size(); ++c)
    if (record.signal_columns[c] == signal)
      for (std::size_t i = 0; i < record.rows(); ++i) out.push_back(SignalColumn{record, c}[i]);
  return out;
}

double first_of(const RunRecord& record, const std::string& signal) {
  const std::vector<double> column = all_of(record, signal);
  return column.empty() ? std::numeric_limits<double>::quiet_NaN() : column.front();
}

double last_of(const RunRecord& record, const std::string& signal) {
  const std::vector<double> column = all_of(record, signal);
  return column.empty() ? std::numeric_limits<double>::quiet_NaN() : column.back();
}

}  // namespace ostium::data
