#pragma once
/// A case: a patient to rehearse on.
#include <string>
#include <vector>

#include "vascular/patient.h"

namespace ostium {

/// What the operator is told before the procedure.
struct CaseCard {
  std::string history, ecg, planned_access;
};

struct Case {
  std::string name;  ///< the file's name without .json
  std::string title;
  CaseCard card;
  AnatomyParameters anatomy;
  std::uint64_t seed = 0;  ///< of the person; 0: the mean
  double rate_1_min = 70;  ///< heart beats
  std::vector<Lesion> lesions;
};

/// Throws LoadError with file, line, key, value found and what was expected. The anatomy is built for that: a lesion
/// that does not fit its branch is refused with what exists.
Case read_case(const std::string& file, const std::string& text);
Case load_case(const std::string& file);

/// All of data/cases, or one of them; throws LoadError also for a name that is none, with those that are.
std::vector<Case> load_cases();
Case find_case(const std::string& name);

/// A table's line, and everything as JSON (data/schemas/cases.schema.json).
std::string case_heading();
std::string case_line(const Case& c);
std::string case_details(const Case& c);
std::string to_json(const std::vector<Case>& cases);

}  // namespace ostium
