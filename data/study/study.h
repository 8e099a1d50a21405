#pragma once
/// A validation study as it comes in: who took part, what their runs came to, what they answered.
#include <string>
#include <vector>

namespace ostium::data {

struct Participant {
  std::string code, group;         ///< no name
  std::vector<std::string> about;  ///< in the order of Study::about
};

/// A run of a participant. `values` in the order of Study::metrics; NaN: does not apply.
struct StudyRun {
  std::size_t participant = 0;
  int trial = 1;
  std::string case_name, outcome;
  std::vector<double> values;
};

/// Of a statement of the questionnaire, from 1 (not at all) to 5 (fully).
struct StudyAnswer {
  std::size_t participant = 0;
  std::string part, statement, remark;
  int answer = 0;  ///< 0: none, but a remark
};

struct Study {
  std::vector<std::string> about;  ///< what is known of participants: procedures, years, ...
  std::vector<Participant> participants;
  std::vector<std::string> groups, metrics, cases;  ///< in the order in which they come
  std::vector<StudyRun> runs;
  std::vector<StudyAnswer> answers;
};

/// `participants`: a table `code,group`, and what else is known of them. `runs`: tables of `ostium report --csv`, whose
/// codes are a participant's, with the trial's number behind it where there are several ("P01-2"). `answers`: tables as
/// the questionnaire saves them; what they say about the participant joins what the participants' table says. Throws
/// LoadError with file and line for a code that is no participant's, a trial twice, a value that is no number, an
/// answer outside 1 to 5, a statement answered twice.
Study read_study(const std::string& participants, const std::vector<std::string>& runs,
                 const std::vector<std::string>& answers);

}  // namespace ostium::data
