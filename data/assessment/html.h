#pragma once
/// Helpers for the pages and tables of a run.
#include <string>

namespace ostium::data {

/// A whole HTML page. Its script's `save(id, file)` saves a table as CSV, including its boxes and choices.
std::string html_page(const std::string& title, const std::string& body);

std::string time_text(double s);  ///< "2:03.5"

}  // namespace ostium::data
