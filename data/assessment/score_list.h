#pragma once
/// A checklist of a procedure's steps, errors and critical errors that anybody may edit (data/scoring/NAME.json,
/// schemas/scoring.schema.json), ticked from a recording. There is no sum and no pass mark: it is a draft to be agreed
/// on.
#include <optional>
#include <string>
#include <vector>

#include "data/assessment/metrics.h"

namespace ostium::data {

enum class ScoreKind { step, error, critical };

/// What a recording must show: either `event` or `metric`. Items without a check can only be judged by a person.
struct ScoreCheck {
  std::optional<EventCode> event;
  std::string before;  ///< an event that the first `event` must precede; no score if it never comes
  std::string metric;
  std::optional<double> least, most;  ///< limits of the number of events, or of the metric's value
};

struct ScoreItem {
  std::string id, phase, what, when;  ///< `when`: its definition
  ScoreKind kind = ScoreKind::step;
  std::optional<ScoreCheck> check;
};

struct ScoreList {
  std::string name, title, note;
  std::vector<ScoreItem> items;
};

/// Throws LoadError with file, line, key and what was expected.
ScoreList read_score_list(const std::string& file, const std::string& text);
/// data/scoring/NAME.json, or a file.
ScoreList find_score_list(const std::string& name_or_file);

enum class Ticked { yes, no, not_seen };  ///< not_seen: cannot be told from the recording
struct Score {
  Ticked holds = Ticked::not_seen;  ///< yes: the step was done, or the error did not happen
  std::vector<double> at_s;         ///< when: for a step the time at which it was done, for an error every time
  std::string value;                ///< "3.2 mm"; empty if there is none
};
/// One score for each of the list's items.
std::vector<Score> score(const ScoreList& list, const RunRecord& record, const std::vector<Metric>& metrics);

}  // namespace ostium::data
