#include "data/study/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "data/formats/csv_table.h"
#include "data/formats/decimal.h"
#include "data/formats/load_error.h"

namespace ostium::data {

namespace {

/// Columns of `ostium report --csv` that say which run it is, and are no metrics.
const std::set<std::string> of_the_run = {"code", "case", "script", "seed", "outcome", "reason", "simulated_s"};

[[noreturn]] void refuse_row(const std::string& file, int line, const std::string& what) {
  throw LoadError(fmt::format("{}:{}: {}", file, line, what));
}

std::size_t column_in(const CsvTable& table, const std::string& file, const std::string& name) {
  const auto found = std::ranges::find(table.columns, name);
  if (found == table.columns.end())
    refuse_row(file, table.header_line, fmt::format("there is no column \"{}\"; expected one", name));
  return static_cast<std::size_t>(found - table.columns.begin());
}

/// What stands twice would count once, whichever.
void require_different_columns(const CsvTable& table, const std::string& file) {
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    if (std::count(table.columns.begin(), table.columns.end(), table.columns[c]) > 1)
      refuse_row(
          file, table.header_line,
          fmt::format("there are several columns \"{}\"; expected a name of its own for each", table.columns[c]));
}

std::size_t place_in(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

bool same_letters(const std::string& a, const std::string& b) {
  return std::ranges::equal(
      a, b, {}, [](unsigned char c) { return std::tolower(c); }, [](unsigned char c) { return std::tolower(c); });
}

class StudyReader {
 public:
  void add_participants(const std::string& file) {
    const CsvTable table = load_csv(file, "code, group");
    require_different_columns(table, file);
    const std::size_t code = column_in(table, file, "code"), group = column_in(table, file, "group");
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      if (c != code && c != group) study_.about.push_back(table.columns[c]);
    for (const CsvRow& row : table.rows) {
      Participant one{row.fields[code], row.fields[group], {}};
      if (one.code.empty() || one.group.empty())
        refuse_row(file, row.line, "a participant without a code or a group; expected both");
      if (!of_code_.try_emplace(one.code, study_.participants.size()).second)
        refuse_row(file, row.line, fmt::format("there is another participant {}; expected a code for each", one.code));
      for (std::size_t c = 0; c < row.fields.size(); ++c)
        if (c != code && c != group) one.about.push_back(row.fields[c]);
      for (const std::string& known : study_.groups)
        if (known != one.group && same_letters(known, one.group))
          refuse_row(file, row.line,
                     fmt::format("there are groups \"{}\" and \"{}\"; expected one spelling", known, one.group));
      place_in(study_.groups, one.group);
      study_.participants.push_back(std::move(one));
    }
    if (study_.participants.empty()) throw LoadError(file + ": has no participant; expected a row for each");
  }

  void add_runs(const std::string& file) {
    const CsvTable table = load_csv(file, "code, case, outcome and metrics, as of `ostium report --csv`");
    require_different_columns(table, file);
    const std::size_t code = column_in(table, file, "code"), of_case = column_in(table, file, "case"),
                      outcome = column_in(table, file, "outcome");
    std::vector<std::pair<std::size_t, std::size_t>> metrics;  // column, place
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      if (!of_the_run.contains(table.columns[c]) && !table.columns[c].starts_with("item_"))
        metrics.emplace_back(c, place_in(study_.metrics, table.columns[c]));
    for (const CsvRow& row : table.rows) {
      StudyRun run;
      std::tie(run.participant, run.trial) = participant_and_trial(file, row.line, row.fields[code]);
      run.case_name = row.fields[of_case], run.outcome = row.fields[outcome];
      place_in(study_.cases, run.case_name);
      for (const StudyRun& other : study_.runs)
        if (other.participant == run.participant && other.trial == run.trial && other.case_name == run.case_name)
          refuse_row(file, row.line,
                     fmt::format("trial {} of {} in {} is there already; expected each once, as {}-{}", run.trial,
                                 study_.participants[run.participant].code, run.case_name,
                                 study_.participants[run.participant].code, run.trial + 1));
      run.values.assign(study_.metrics.size(), std::nan(""));
      for (const auto& [c, m] : metrics)
        if (!row.fields[c].empty()) run.values[m] = csv_number(file, row, table.columns[c], row.fields[c]);
      study_.runs.push_back(std::move(run));
    }
  }

  void add_answers(const std::string& file) {
    for (const CsvRow& row : load_csv(file, {"code", "part", "statement", "answer", "remark"})) {
      if (row.fields[3].empty() && row.fields[4].empty()) continue;  // not answered
      const auto found = of_code_.find(row.fields[0]);
      if (found == of_code_.end()) refuse_code(file, row.line, row.fields[0]);
      if (row.fields[1] == "about") {
        add_about(file, row, found->second);
        continue;
      }
      const std::optional<double> answer = decimal(row.fields[3]);
      const bool remark_only = row.fields[3].empty();
      if (!remark_only && (!answer || *answer != std::floor(*answer) || *answer < 1 || *answer > 5))
        refuse_row(file, row.line, fmt::format("the answer is \"{}\"; expected 1, 2, 3, 4 or 5", row.fields[3]));
      const StudyAnswer one{found->second, row.fields[1], row.fields[2], row.fields[4],
                            static_cast<int>(answer.value_or(0))};
      for (const StudyAnswer& other : study_.answers)
        if (other.participant == one.participant && other.part == one.part && other.statement == one.statement)
          refuse_row(file, row.line,
                     fmt::format("{} has answered \"{}\" already; expected one answer", row.fields[0], one.statement));
      study_.answers.push_back(one);
    }
  }

  Study take() {
    for (StudyRun& run : study_.runs) run.values.resize(study_.metrics.size(), std::nan(""));
    for (Participant& one : study_.participants) one.about.resize(study_.about.size());
    return std::move(study_);
  }

 private:
  void add_about(const std::string& file, const CsvRow& row, std::size_t participant) {
    const std::size_t column = place_in(study_.about, row.fields[2]);
    std::vector<std::string>& about = study_.participants[participant].about;
    about.resize(std::max(about.size(), column + 1));
    if (!about[column].empty() && about[column] != row.fields[3])
      refuse_row(file, row.line,
                 fmt::format("{} of {} is \"{}\", and was \"{}\" before; expected one answer", row.fields[2],
                             row.fields[0], row.fields[3], about[column]));
    about[column] = row.fields[3];
  }

  [[noreturn]] void refuse_code(const std::string& file, int line, const std::string& code) const {
    refuse_row(
        file, line,
        fmt::format("{} is no participant's code; expected one of the participants' table, with the trial's number "
                    "behind it where there are several: {}-2",
                    code.empty() ? "nothing" : "\"" + code + "\"", study_.participants.front().code));
  }

  std::pair<std::size_t, int> participant_and_trial(const std::string& file, int line, const std::string& code) const {
    if (const auto whole = of_code_.find(code); whole != of_code_.end()) return {whole->second, 1};
    const std::size_t dash = code.rfind('-');
    if (dash == std::string::npos) refuse_code(file, line, code);
    const auto found = of_code_.find(code.substr(0, dash));
    const std::optional<double> trial = decimal(code.substr(dash + 1));
    constexpr double most_trials = 1000;
    if (found == of_code_.end() || !trial || *trial != std::floor(*trial) || *trial < 1 || *trial > most_trials)
      refuse_code(file, line, code);
    return {found->second, static_cast<int>(*trial)};
  }

  Study study_;
  std::map<std::string, std::size_t> of_code_;
};

}  // namespace

Study read_study(const std::string& participants, const std::vector<std::string>& runs,
                 const std::vector<std::string>& answers) {
  StudyReader reader;
  reader.add_participants(participants);
  for (const std::string& file : runs) reader.add_runs(file);
  for (const std::string& file : answers) reader.add_answers(file);
  return reader.take();
}

}  // namespace ostium::data
