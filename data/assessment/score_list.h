#pragma once
/// Steps, errors and critical errors of a procedure, as a list that anybody may edit (data/scoring/NAME.json,
/// schemas/scoring.schema.json), ticked by what a recording shows. No sum, no pass mark: a draft to be agreed on.
#include <optional>
#include <string>
#include <vector>

#include "data/assessment/metrics.h"

namespace ostium::data {

enum class ScoreKind { step, error, critical };

/// What a recording must show. One of `event` and `metric`; without either only a person can tell.
struct ScoreCheck {
  std::optional<EventCode> event;
  std::string before;  ///< an event's name: `event` has to come first, as often as that comes at all
  std::string metric;
  std::optional<double> least, most;  ///< of how many events, or of the metric's value
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

enum class Ticked { yes, no, not_seen };  ///< not_seen: the recording does not say
struct Score {
  Ticked holds = Ticked::not_seen;  ///< the step was done; the error did not happen
  std::vector<double> at_s;         ///< when: of a step the first time, of an error every time
  std::string value;                ///< "3.2 mm"; empty: none
};
/// One each of the list's items.
std::vector<Score> score(const ScoreList& list, const RunRecord& record, const std::vector<Metric>& metrics);

}  // namespace ostium::data
