#pragma once
/// Control characters in texts and names of files: C0, DEL, and C1, which is two bytes of UTF-8.
#include <string>
#include <string_view>

namespace ostium::data {

/// Whether a character of it would move a terminal's cursor, change its colours or ring; those in `allowed` do not
/// count.
bool has_control(std::string_view text, std::string_view allowed = "");

/// The text with a question mark for each of these.
std::string without_controls(std::string_view text, std::string_view allowed = "");

}  // namespace ostium::data
