#include "data/formats/controls.h"

namespace ostium::data {

namespace {

/// How many bytes the control character at `i` has; 0: there is none.
std::size_t control_at(std::string_view text, std::size_t i, std::string_view allowed) {
  const auto c = static_cast<unsigned char>(text[i]);
  if ((c < ' ' || c == 0x7f) && allowed.find(text[i]) == std::string_view::npos) return 1;
  return c == 0xc2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0 ? 2 : 0;
}

}  // namespace

bool has_control(std::string_view text, std::string_view allowed) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (control_at(text, i, allowed) > 0) return true;
  return false;
}

std::string without_controls(std::string_view text, std::string_view allowed) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t bytes = control_at(text, i, allowed);
    out += bytes > 0 ? '?' : text[i];
    if (bytes > 1) ++i;
  }
  return out;
}

}  // namespace ostium::data
