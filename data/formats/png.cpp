#include "data/formats/png.h"

#include <png.h>

#include <fstream>
#include <string_view>
#include <vector>

#include "data/formats/load_error.h"
#include "data/formats/write_file.h"

namespace ostium::data {

namespace {

/// Compresses in memory first: given a file name, libpng would on failure remove whatever has that name.
std::vector<std::uint8_t> compressed(int width, int height, png_uint_32 format, const void* pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = format;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::uint8_t> bytes(size);
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, nullptr))
    throw LoadError(std::string("PNG: ") + image.message);
  bytes.resize(size);
  return bytes;
}

void write_bytes(const std::string& file, const std::vector<std::uint8_t>& bytes) {
  write_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

std::vector<std::uint8_t> png_of(const fluoro::Picture& picture) {
  return compressed(picture.width, picture.height, PNG_FORMAT_GRAY, picture.grey.data());
}

void write_png(const std::string& file, const fluoro::Picture& picture) { write_bytes(file, png_of(picture)); }

void write_rgb_png(const std::string& file, int width, int height, const std::vector<std::uint8_t>& rgb) {
  write_bytes(file, rgb_png_of(width, height, rgb));
}

void write_grey16_png(const std::string& file, int width, int height, const std::vector<std::uint16_t>& grey) {
  write_bytes(file, compressed(width, height, PNG_FORMAT_LINEAR_Y, grey.data()));
}

bool is_whole_png(const std::string& file) {
  using namespace std::string_view_literals;
  constexpr std::string_view begins = "\x89PNG\r\n\x1a\n"sv, ends = "\0\0\0\0IEND\xae\x42\x60\x82"sv;
  char first[begins.size()], last[ends.size()];
  std::ifstream in(file, std::ios::binary);
  return in.read(first, sizeof first) && in.seekg(-static_cast<std::streamoff>(sizeof last), std::ios::end) &&
         in.read(last, sizeof last) && std::string_view(first, sizeof first) == begins &&
         std::string_view(last, sizeof last) == ends;
}

std::vector<std::uint8_t> rgb_png_of(int width, int height, const std::vector<std::uint8_t>& rgb) {
  return compressed(width, height, PNG_FORMAT_RGB, rgb.data());
}

}  // namespace ostium::data
