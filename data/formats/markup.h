#pragma once
/// Pieces of HTML and SVG.
#include <cstdint>
#include <span>
#include <string>

namespace ostium::data {

/// `words` escaped for HTML and SVG.
std::string escaped(const std::string& words);

/// A PNG file as the address of a picture within a page.
std::string data_uri(std::span<const std::uint8_t> png);

}  // namespace ostium::data
