#pragma once
/// A study as a page, as a table for statistics packages, and as JSON.
#include "data/study/comparison.h"

namespace ostium::data {

/// HTML that needs nothing else. Metrics whose difference is surest come first.
std::string study_page(const Study& study, const std::vector<ComparedCase>& compared);
/// A row for each case and metric: n, median and quartiles of each group; of each pair U, superiority, p, Holm's p; ICC
/// with its interval.
std::string study_csv(const Study& study, const std::vector<ComparedCase>& compared);
/// data/schemas/study.schema.json
std::string study_json(const Study& study, const std::vector<ComparedCase>& compared);

}  // namespace ostium::data
