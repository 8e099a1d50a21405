#include "data/formats/markup.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/ofstd/ofstd.h>

namespace ostium::data {

std::string escaped(const std::string& words) {
  std::string out;
  for (char c : words)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

std::string data_uri(std::span<const std::uint8_t> png) {
  OFString text;
  OFStandard::encodeBase64(png.data(), png.size(), text);
  return "data:image/png;base64," + std::string(text.c_str());
}

}  // namespace ostium::data
