#include "data/picture/frames_file.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <filesystem>

#include "data/formats/load_error.h"
#include "data/formats/paths.h"
#include "data/formats/read_file.h"

namespace ostium::data {

namespace {

namespace fs = std::filesystem;

constexpr int least_side = 64;

std::string ending(const fs::path& file) {
  std::string out = file.extension().string();
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

}  // namespace

FramesFile read_png_frame(const std::string& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&png, file.c_str()))
    throw LoadError(fmt::format("{}: not a PNG that can be read: {}", file, png.message));
  const bool is_16_bit = png.format & PNG_FORMAT_FLAG_LINEAR, is_colour = png.format & PNG_FORMAT_FLAG_COLOR;
  const Eigen::Index rows = png.height, columns = png.width;
  constexpr Eigen::Index most_pixels = 64'000'000;  // ten times a plain film's; a header may claim anything
  if (rows * columns > most_pixels) {
    png_image_free(&png);
    throw LoadError(fmt::format("{}: not a PNG that can be read: {} x {} pixels; expected at most {} million", file,
                                columns, rows, most_pixels / 1'000'000));
  }
  FramesFile out;
  Image image(rows, columns);
  bool read = false;
  if (is_16_bit) {
    png.format = PNG_FORMAT_LINEAR_Y;
    std::vector<png_uint_16> grey(static_cast<std::size_t>(rows * columns));
    read = png_image_finish_read(&png, nullptr, grey.data(), 0, nullptr);
    for (Eigen::Index i = 0; i < image.size(); ++i) image.data()[i] = grey[static_cast<std::size_t>(i)] / 257.0;
    out.remarks.push_back("16 bits: 65535 is taken as white");
  } else {
    png.format = PNG_FORMAT_RGB;
    std::vector<png_byte> rgb(3 * static_cast<std::size_t>(rows * columns));
    read = png_image_finish_read(&png, nullptr, rgb.data(), 0, nullptr);
    for (Eigen::Index i = 0; i < image.size(); ++i) {
      const png_byte* p = rgb.data() + 3 * i;
      image.data()[i] = (p[0] + p[1] + p[2]) / 3.0;
    }
  }
  if (!read) throw LoadError(fmt::format("{}: not a PNG that can be read: {}", file, png.message));
  if (is_colour) out.remarks.push_back("colour: the mean of red, green and blue is taken");
  out.frames.push_back(std::move(image));
  return out;
}

FramesFile read_frames(const std::string& file) {
  const std::string kind = ending(file);
  require_file(file, "a PNG or DICOM file");
  FramesFile out = kind == ".png" ? read_png_frame(file) : read_dicom_frames(file);
  const Eigen::Index rows = out.frames.front().rows(), columns = out.frames.front().cols();
  if (std::min(rows, columns) < least_side)
    throw LoadError(fmt::format("{}: {} x {} pixels; expected {} a side at least", file, columns, rows, least_side));
  if (rows != columns) out.remarks.push_back(fmt::format("{} x {}: its middle square is taken", columns, rows));
  if (std::min(rows, columns) != measured_side)
    out.remarks.push_back(fmt::format("{} x {}: brought to {}", columns, rows, measured_side));
  if (std::any_of(out.frames.begin(), out.frames.end(), seems_to_have_text))
    out.remarks.push_back("text seems to lie on it, which counts as edges: take it without");
  return out;
}

bool seems_to_have_text(const Image& image) {
  // White within a pixel or two of much darker ones on both sides.
  constexpr double white = 240, darker = 70;
  constexpr int least_pixels = 120;
  int strokes = 0;
  for (Eigen::Index y = 3; y + 3 < image.rows(); ++y)
    for (Eigen::Index x = 3; x + 3 < image.cols(); ++x) {
      const double grey = image(y, x);
      if (grey < white) continue;
      const auto thin = [&](double before, double after) { return std::max(before, after) < grey - darker; };
      strokes += thin(image(y, x - 3), image(y, x + 3)) || thin(image(y - 3, x), image(y + 3, x));
    }
  return strokes >= least_pixels;
}

std::vector<std::string> frame_files(const std::string& file_or_folder) {
  if (!is_folder(file_or_folder)) return {file_or_folder};
  std::vector<std::string> out;
  for (const fs::directory_entry& entry : fs::directory_iterator(file_or_folder))
    if (const std::string kind = ending(entry.path()); entry.is_regular_file() && (kind == ".png" || kind == ".dcm"))
      out.push_back(entry.path().string());
  if (out.empty()) throw LoadError(file_or_folder + ": no frames in it; expected files .png or .dcm");
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace ostium::data
