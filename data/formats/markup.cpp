#include "data/formats/markup.h"

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>

namespace ostium::data {

std::string escaped(const std::string& words) {
  std::string out;
  for (char c : words)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

std::string data_uri(std::span<const std::uint8_t> png) {
  using namespace boost::archive::iterators;
  using Letters = base64_from_binary<transform_width<const std::uint8_t*, 6, 8>>;
  const std::string text(Letters(png.data()), Letters(png.data() + png.size()));
  return "data:image/png;base64," + text + std::string((3 - png.size() % 3) % 3, '=');
}

}  // namespace ostium::data
