#include <fmt/format.h>

#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/templates.h"
#include "data/formats/csv_table.h"
#include "data/formats/load_error.h"
#include "data/formats/write_file.h"
#include "data/study/study_page.h"

namespace ostium::app {

namespace {

struct Arguments {
  std::string participants, to_begin_from;  ///< empty: none
  std::vector<std::string> runs, answers;
  std::string page = "study.html", csv;  ///< csv empty: none
  bool json = false;
};

void declare(Options& options, Arguments& a) {
  options.add("participants", a.participants, "Table: code, group, and what else is known of them").type("FILE.csv");
  options.add("--runs", a.runs, "What `ostium report --csv` wrote; codes are P01, or P01-2 for a second trial")
      .type("FILE.csv");
  options.add("--answers", a.answers, "What the questionnaire saved (`ostium report --questionnaire`)")
      .type("FILE.csv");
  options.add("-o,--output", a.page, "The page, which needs nothing else").type("FILE.html").show_default().writes();
  options.add("--csv", a.csv, "The same as a table").type("FILE.csv").writes();
  options
      .add("--template", a.to_begin_from,
           "Write a protocol, consent, instructions, the trials and the participants' table there")
      .type("DIR");
  add_json_flag(options, a.json);
}

int run(const Arguments& a) {
  if (!a.to_begin_from.empty()) {
    if (!a.participants.empty() || !a.runs.empty() || !a.answers.empty() || !a.csv.empty() || a.json)
      throw data::LoadError("--template writes files to begin from, and reads no study; expected one of them");
    for (const std::string& file : write_template_of("study/template", a.to_begin_from)) fmt::print("{}\n", file);
    return 0;
  }
  if (a.participants.empty() || (a.runs.empty() && a.answers.empty()))
    throw data::LoadError(
        "nothing to compare; expected the participants' table and --runs or --answers, or --template DIR");
  const data::Study study = data::read_study(a.participants, a.runs, a.answers);
  std::vector<std::string> read = a.runs;
  read.push_back(a.participants), read.insert(read.end(), a.answers.begin(), a.answers.end());
  for (const std::string& file : read)
    if (const std::string doubt = data::doubt_of_end(file); !doubt.empty())
      fmt::print(stderr, "ostium study: {}\n", doubt);
  const std::vector<data::ComparedCase> compared = compare(study);
  std::vector<data::FileText> files = {{a.page, study_page(study, compared)}};
  if (!a.csv.empty()) files.push_back({a.csv, study_csv(study, compared)});
  data::write_files(files);
  fmt::print("{}", a.json ? study_json(study, compared) : a.page + "\n");
  return 0;
}

}  // namespace

Command study_command() {
  return make_command("study", "Groups, trials and answers of a validation study, compared",
                      {"ostium study --template my-study",
                       "ostium study participants.csv --runs runs.csv --answers answers-P01.csv answers-P02.csv",
                       "ostium study participants.csv --runs runs.csv -o study.html --csv study.csv --json"},
                      declare, run);
}

}  // namespace ostium::app
