#include "fluoro/display/overlay.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "core/base/units.h"
#include "fluoro/projection/views.h"

namespace ostium::fluoro {

namespace {

/// Draws in white on a transparent sheet that is then composited onto the picture.
class Sheet {
 public:
  Sheet(int width, int height)
      : surface_(cairo_image_surface_create(CAIRO_FORMAT_A8, width, height), cairo_surface_destroy),
        pen_(cairo_create(surface_.get()), cairo_destroy) {
    cairo_select_font_face(pen(), "DejaVu Sans Mono", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  }
  cairo_t* pen() { return pen_.get(); }

  void write(double x, double y, double size, const std::string& text, bool from_right = false) {
    cairo_set_font_size(pen(), size);
    cairo_text_extents_t extents;
    cairo_text_extents(pen(), text.c_str(), &extents);
    cairo_move_to(pen(), from_right ? x - extents.x_advance : x, y);
    cairo_show_text(pen(), text.c_str());
  }

  /// Draws letters in white, with a dark rim that keeps them legible on bright lung.
  void lay_over(Picture& picture, int top) {
    cairo_surface_flush(surface_.get());
    const int width = cairo_image_surface_get_width(surface_.get()),
              height = cairo_image_surface_get_height(surface_.get());
    const int stride = cairo_image_surface_get_stride(surface_.get());
    const unsigned char* alpha = cairo_image_surface_get_data(surface_.get());
    const auto ink = [&](int x, int y) {
      return x < 0 || y < 0 || x >= width || y >= height ? 0 : int(alpha[y * stride + x]);
    };
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        int rim = 0;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) rim = std::max(rim, ink(x + dx, y + dy));
        if (rim == 0) continue;
        std::uint8_t& grey = picture.grey[std::size_t(y + top) * std::size_t(picture.width) + std::size_t(x)];
        const double darkened = grey * (1 - 0.8 * rim / 255);
        grey = static_cast<std::uint8_t>(darkened + (245 - darkened) * ink(x, y) / 255);
      }
  }

 private:
  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
  std::unique_ptr<cairo_t, void (*)(cairo_t*)> pen_;
};

template <typename... Values>
std::string text(const char* format, Values... values) {
  char out[120];
  std::snprintf(out, sizeof out, format, values...);
  return out;
}

std::string minutes(double seconds) {
  const auto whole = static_cast<long>(seconds);  // completed
  return text("%ld:%02ld", whole / 60, whole % 60);
}

/// The trefoil of ISO 361.
void radiation_sign(cairo_t* pen, double x, double y, double size) {
  using units::pi;
  cairo_new_path(pen);
  cairo_arc(pen, x, y, 0.18 * size, 0, 2 * pi);
  cairo_fill(pen);
  for (int blade = 0; blade < 3; ++blade) {
    const double middle = -pi / 2 + pi / 3 + blade * 2 * pi / 3;
    cairo_new_path(pen);
    cairo_arc(pen, x, y, size, middle - pi / 6, middle + pi / 6);
    cairo_arc_negative(pen, x, y, 0.28 * size, middle + pi / 6, middle - pi / 6);
    cairo_close_path(pen);
    cairo_fill(pen);
  }
}

}  // namespace

void draw_captions(const std::vector<std::string>& lines, Picture& picture) {
  Sheet sheet(picture.width, picture.height);
  const double size = std::max(10.0, picture.width / 42.0), line = 1.35 * size, margin = 0.8 * size;
  double down = margin + size;
  for (const std::string& one : lines) sheet.write(margin, down, size, one), down += line;
  sheet.lay_over(picture, 0);
}

void draw_overlay(const OverlayText& t, Picture& picture) {
  using units::degree;
  Sheet sheet(picture.width, picture.height);
  const double size = std::max(10.0, picture.width / 42.0), line = 1.35 * size, margin = 0.8 * size;
  const double right = picture.width - margin, bottom = picture.height - margin;
  const bool is_cine = t.programme.mode == Mode::cine;

  sheet.write(margin, margin + size, size, t.patient.empty() ? "OSTIUM" : t.patient);
  sheet.write(margin, margin + size + line, size,
              angles_text(t.view.arm.lao_rad / degree, t.view.arm.cran_rad / degree));
  sheet.write(margin, margin + size + 2 * line, size, text("SID %.0f cm", 100 * t.view.arm.source_to_detector_m));
  sheet.write(margin, margin + size + 3 * line, size, text("FD %.0f cm", 100 * t.view.field_m));

  sheet.write(right, margin + size, size,
              !t.state.empty() ? t.state : (t.xray_on ? (is_cine ? "CINE" : "FLUORO") : "LIH"), true);
  sheet.write(right, margin + size + line, size, text("%g f/s", t.programme.frames_per_s), true);
  sheet.write(right, margin + size + 2 * line, size,
              text("%.0f kV  %.1f Cu", t.exposure.tube.peak_kV, t.exposure.tube.copper_mm), true);
  if (t.xray_on) radiation_sign(sheet.pen(), right - 0.9 * size, margin + size + 3.2 * line, 0.95 * size);

  sheet.write(margin, bottom - line, size, "fluoro " + minutes(t.dose.fluoroscopy_s));
  sheet.write(margin, bottom, size,
              text("cine %ld f, %ld run%s", t.dose.cine_frames, t.dose.cine_runs, t.dose.cine_runs == 1 ? "" : "s"));
  sheet.write(right, bottom - line, size, text("DAP %.2f Gy cm\u00b2", 1e4 * t.dose.dose_area_Gy_m2), true);
  sheet.write(right, bottom, size, text("AK %.1f mGy", 1e3 * t.dose.kerma_Gy), true);
  sheet.lay_over(picture, 0);
}

void append_strips(const std::vector<Strip>& strips, double seconds, int height, Picture& picture) {
  const int top = picture.height;
  picture.height += height;
  picture.grey.resize(std::size_t(picture.width) * std::size_t(picture.height), 0);
  if (strips.empty()) return;
  Sheet sheet(picture.width, height);
  const double share = double(height) / double(strips.size()), size = std::clamp(0.2 * share, 9.0, 16.0);
  const double left = 4.5 * size, right = picture.width - 4.5 * size, width = right - left;
  cairo_set_line_width(sheet.pen(), 1);
  cairo_set_source_rgba(sheet.pen(), 1, 1, 1, 0.25);
  for (int s = 0; s <= static_cast<int>(seconds); ++s) {
    cairo_move_to(sheet.pen(), std::floor(right - width * s / seconds) + 0.5, 0);
    cairo_rel_line_to(sheet.pen(), 0, height);
    cairo_stroke(sheet.pen());
  }
  cairo_set_source_rgba(sheet.pen(), 1, 1, 1, 1);
  cairo_set_line_width(sheet.pen(), 1.4);
  for (std::size_t k = 0; k < strips.size(); ++k) {
    const Strip& strip = strips[k];
    const double from = share * double(k);
    sheet.write(0.5 * size, from + 0.5 * share, size, strip.name);
    if (strip.samples.empty() || !(strip.most > strip.least)) continue;
    sheet.write(right + 0.4 * size, from + 0.5 * share, size,
                text("%.*f", strip.most - strip.least < 10 ? 1 : 0, double(strip.samples.back())));
    sheet.write(right + 0.4 * size, from + 0.5 * share + 1.2 * size, 0.75 * size, strip.unit);
    const auto count = std::min(strip.samples.size(), static_cast<std::size_t>(seconds * strip.samples_per_s));
    cairo_new_path(sheet.pen());  // text leaves the current point at its end
    for (std::size_t i = 0; i < count; ++i) {
      const double back_s = double(i) / strip.samples_per_s;
      const double value = double(strip.samples[strip.samples.size() - 1 - i]);
      const double y =
          from + share * (0.92 - 0.84 * std::clamp((value - strip.least) / (strip.most - strip.least), 0.0, 1.0));
      cairo_line_to(sheet.pen(), right - width * back_s / seconds, y);
    }
    cairo_stroke(sheet.pen());
  }
  sheet.lay_over(picture, top);
}

Picture beside(const Picture& left, const Picture& right) {
  Picture out{left.width + right.width, std::max(left.height, right.height), {}};
  out.grey.assign(std::size_t(out.width) * std::size_t(out.height), 0);
  const auto copy = [&](const Picture& from, int column) {
    for (int row = 0; row < from.height; ++row)
      std::copy_n(from.grey.begin() + std::ptrdiff_t(row) * from.width, from.width,
                  out.grey.begin() + std::ptrdiff_t(row) * out.width + column);
  };
  copy(left, 0);
  copy(right, left.width);
  return out;
}

}  // namespace ostium::fluoro
