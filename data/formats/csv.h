#pragma once
#include <string>

namespace ostium::data {

/// A text as a field of a CSV file (RFC 4180): quoted where it has to be. What a spreadsheet would take for a formula
/// (a text that begins with =, +, -, @, their wide forms or a control character) gets an apostrophe in front, so that
/// it stays a text.
std::string csv_field(const std::string& text);

}  // namespace ostium::data
