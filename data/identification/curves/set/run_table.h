#pragma once
/// Runs whose samples are the columns of a table: `"csv": "run1.csv"` in a run, in place of its lists.
#include "data/formats/json/json_value.h"

namespace ostium::data::curves {

/// `root` with the tables that its runs name written out as lists: each column under its name, `density_mm[0]`,
/// `density_mm[1]` ... as a list of lists. Tables lie beside the file. Throws LoadError.
JsonValue with_tables(JsonValue root);

/// Words of doubt about the tables that were written out in `root`.
std::vector<std::string> doubts_of_tables(const JsonValue& root);

}  // namespace ostium::data::curves
