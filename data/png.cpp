#include "data/png.h"

#include <png.h>

#include <cstdio>
#include <vector>

#include "data/load_error.h"
#include "data/unfinished_file.h"

namespace ostium {

namespace {

/// Compressed in memory first: libpng, given a name, would on failure remove whatever bears it.
std::vector<unsigned char> compressed(const Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_GRAY;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<unsigned char> bytes(size);
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.grey.data(), 0, nullptr))
    throw LoadError(std::string("PNG: ") + image.message);
  bytes.resize(size);
  return bytes;
}

}  // namespace

void write_png(const std::string& file, const Picture& picture) {
  const std::vector<unsigned char> bytes = compressed(picture);
  std::FILE* out = std::fopen(file.c_str(), "wb");
  const bool written = out && std::fwrite(bytes.data(), 1, bytes.size(), out) == bytes.size();
  const bool closed = out && std::fclose(out) == 0;
  if (written && closed) return;
  if (out) remove_unfinished(file);
  throw LoadError(file + ": cannot be written; does its folder exist, and is there room?");
}

}  // namespace ostium
