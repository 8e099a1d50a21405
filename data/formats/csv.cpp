#include "data/formats/csv.h"

namespace ostium::data {

std::string csv_field(const std::string& text) {
  // The wide forms are taken for formulas too, where people type them.
  const bool wide = text.starts_with("\uff1d") || text.starts_with("\uff0b") || text.starts_with("\uff0d") ||
                    text.starts_with("\uff20");
  const bool formula = wide || (!text.empty() && (std::string("=+-@").find(text[0]) != std::string::npos ||
                                                  static_cast<unsigned char>(text[0]) < ' '));
  const std::string safe = (formula ? "'" : "") + text;
  if (safe.find_first_of(",\"\r\n") == std::string::npos) return safe;
  std::string quoted = "\"";
  for (char c : safe) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace ostium::data
