#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "fluoro/display/display.h"

namespace ostium::data {

/// 8-bit greyscale PNG. Throws WriteError.
void write_png(const std::string& file, const fluoro::Picture& picture);
/// The same in colour: `rgb` has 3 * width * height bytes, rows from the top.
void write_rgb_png(const std::string& file, int width, int height, const std::vector<std::uint8_t>& rgb);
/// Numbers of 16 bits in grey, rows from the top.
void write_grey16_png(const std::string& file, int width, int height, const std::vector<std::uint16_t>& grey);
/// Whether a PNG file is there to its end: of one that was cut short, as by a machine that lost its power, it is not.
bool is_whole_png(const std::string& file);
/// The bytes of the PNG file.
std::vector<std::uint8_t> png_of(const fluoro::Picture& picture);
std::vector<std::uint8_t> rgb_png_of(int width, int height, const std::vector<std::uint8_t>& rgb);

}  // namespace ostium::data
