#pragma once
/// What the pages and tables of a run are written with.
#include <string>

namespace ostium::data {

/// A whole HTML page; `save(id, file)` in it saves a table, with the boxes and choices in it, as CSV.
std::string html_page(const std::string& title, const std::string& body);

std::string time_text(double s);               ///< "2:03.5"
std::string quoted(const std::string& words);  ///< a field of a CSV file

}  // namespace ostium::data
