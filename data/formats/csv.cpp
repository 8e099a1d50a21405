#include "data/formats/csv.h"

namespace ostium::data {

std::string csv_field(const std::string& text) {
  const bool formula = !text.empty() && (std::string("=+-@").find(text[0]) != std::string::npos || text[0] < ' ');
  const std::string safe = (formula ? "'" : "") + text;
  if (safe.find_first_of(",\"\r\n") == std::string::npos) return safe;
  std::string quoted = "\"";
  for (char c : safe) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace ostium::data
