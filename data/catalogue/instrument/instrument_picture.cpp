#include "data/catalogue/instrument/instrument_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/model/state.h"
#include "core/rod/initial_state.h"
#include "data/catalogue/instrument/instrument_report.h"
#include "data/formats/svg.h"

namespace ostium::data {

namespace {

using Eigen::Vector2d;

// The page, in mm.
constexpr int columns = 6;
constexpr double cell_width = 50, cell_height = 68, shape_top = 12, shape_height = 43, margin = 4, heading = 22;
constexpr double strip_length_m = 0.4;  ///< of the instrument, in the bar below each shape

/// Millimetres of paper per millimetre of instrument.
double scale(const Instrument& instrument) {
  switch (instrument.kind) {
    case InstrumentKind::wire:
      return instrument.outer_diameter_m < 0.5e-3 ? 3.0 : 1.5;
    case InstrumentKind::balloon_shaft:
    case InstrumentKind::stent_shaft:
      return 0.95;  // 45 mm: the longest stent between its markers
    case InstrumentKind::sheath:
      return 0.6;
    default:
      return 0.45;
  }
}

struct Colour {
  double red, green, blue;
};

/// Yellow is soft, dark blue is stiff: logarithmic from 0.2 to 2000 N mm2.
std::string colour_of(double EI_Nmm2) {
  constexpr Colour ramp[] = {{247, 208, 60}, {240, 130, 60}, {200, 62, 90}, {110, 50, 140}, {20, 25, 90}};
  const double place = std::clamp(std::log10(EI_Nmm2 / 0.2) / 4, 0.0, 1.0) * 4;
  const int k = std::min(static_cast<int>(place), 3);
  const auto mix = [&](double a, double b) { return static_cast<int>(std::lround(a + (b - a) * (place - k))); };
  return fmt::format("rgb({},{},{})", mix(ramp[k].red, ramp[k + 1].red), mix(ramp[k].green, ramp[k + 1].green),
                     mix(ramp[k].blue, ramp[k + 1].blue));
}

/// The distal `shown_m` at rest, as node positions from the base, which points down the page, in mm.
std::vector<Vector2d> shape_at_rest(const Instrument& instrument, double shown_m) {
  constexpr int elements = 512;
  core::Model model;
  model.rods = {make_rod(rod_description(instrument, std::vector<double>(elements, shown_m / elements)))};
  // d3 points down the page and d1, towards which plane 0 bends, to the right; page x and y are world x and -z.
  core::EndState base;
  base.q_W = {0, 1, 0, 0};  // half a turn about x
  const core::RodState rod = make_state_at_rest_shape(model, {base}).rods[0];
  std::vector<Vector2d> points;
  for (int i = 0; i < rod.position.size(); ++i)
    points.push_back(1e3 * Vector2d(rod.position[i].x(), -rod.position[i].z()));
  return points;
}

double height(const std::vector<Vector2d>& points) {
  double lowest = 0;
  for (const Vector2d& p : points) lowest = std::max(lowest, p.y());
  return lowest;
}

/// Length from the tip that is bent, plus a straight piece proximal to it.
double bent_length(const Instrument& instrument) {
  double length = 0;
  for (const core::Section& s : instrument.sections)
    if (!s.rest_curvature_per_m.isZero()) length = s.to_tip_m;
  return length;
}

/// As much as fills the height of the cell, at least the distal 6 cm.
double shown_length(const Instrument& instrument) {
  const double height_mm = shape_height / scale(instrument), bent = bent_length(instrument);
  if (bent == 0) return std::min(1e-3 * height_mm, instrument.length_m);
  double shown = bent;
  double curved_mm = height(shape_at_rest(instrument, shown));
  for (; curved_mm > height_mm && shown > 60e-3; curved_mm = height(shape_at_rest(instrument, shown))) shown *= 0.98;
  return std::min(shown + 1e-3 * std::max(height_mm - curved_mm, 0.0), instrument.length_m);
}

class Cell {
 public:
  Cell(Drawing& drawing, const Instrument& instrument, Vector2d corner)
      : drawing_(drawing), instrument_(instrument), corner_(corner), scale_(scale(instrument)) {
    shown_mm_ = 1e3 * shown_length(instrument);
    points_ = shape_at_rest(instrument, 1e-3 * shown_mm_);
    double left = 0, right = 0, bottom = height(points_);
    for (const Vector2d& p : points_) left = std::min(left, p.x()), right = std::max(right, p.x());
    const Vector2d shift(corner.x() + cell_width / 2 - scale_ * (left + right) / 2,
                         corner.y() + shape_top + shape_height - scale_ * bottom);
    for (Vector2d& p : points_) p = shift + scale_ * p;
  }

  void draw() {
    drawing_.text(corner_ + Vector2d(2, 5), instrument_.title, 2.6);
    drawing_.text(corner_ + Vector2d(2, 8.6), instrument_.name, 2.2);
    draw_shape();
    draw_scale_bar();
    draw_strip();
  }

 private:
  /// Thickness on paper: to scale, but never too thin to be seen.
  double thickness(double diameter_m) const { return std::max(1e3 * diameter_m * scale_, 0.45); }

  /// The part between two distances from the tip, m; empty if it is off the page.
  std::vector<Vector2d> part(double from_tip_m, double to_tip_m) const {
    const int last = static_cast<int>(points_.size()) - 1;
    const auto node = [&](double from_tip) { return last - from_tip * 1e3 / shown_mm_ * last; };
    const double first = std::max(node(to_tip_m), 0.0), end = std::min(node(from_tip_m), 1.0 * last);
    std::vector<Vector2d> cut;
    if (end <= first) return cut;
    const auto at = [&](double where) -> Vector2d {
      const int k = std::min(static_cast<int>(where), last - 1);
      return points_[k] + (where - k) * (points_[k + 1] - points_[k]);
    };
    cut.push_back(at(first));
    for (int k = static_cast<int>(first) + 1; k < end; k += 5) cut.push_back(points_[k]);  // every 5th is fine enough
    cut.push_back(at(end));
    return cut;
  }

  void draw_shape() {
    drawing_.line(part(0, 1e-3 * shown_mm_), "#333", thickness(instrument_.sections.back().radius_m * 2) + 0.35);
    const double shown_m = 1e-3 * shown_mm_;
    for (const core::Section& s : instrument_.sections)
      if (s.from_tip_m < shown_m)
        drawing_.line(part(s.from_tip_m, s.to_tip_m), colour_of(EI_Nmm2(s)), thickness(2 * s.radius_m), false);
    for (const OpaqueStretch& s : instrument_.opaque)  // a dark core where the X-ray shows a metal coil or filled tip
      if (s.from_tip_m < shown_m && (s.material == OpaqueMaterial::platinum || s.material == OpaqueMaterial::tungsten))
        drawing_.line(part(s.from_tip_m, s.to_tip_m), "#111", 0.3 * thickness(instrument_.outer_diameter_m));
    for (const OpaqueStretch& s : instrument_.opaque)
      if (s.material == OpaqueMaterial::cobalt_chromium) draw_struts(part(s.from_tip_m, s.to_tip_m));
    for (const Marker& m : instrument_.markers)
      if (m.from_tip_m < shown_m)
        drawing_.line(part(m.from_tip_m, m.from_tip_m + m.length_m), "#111",
                      thickness(instrument_.outer_diameter_m) + 0.5, false);
  }

  /// The zigzag of a crimped stent.
  void draw_struts(const std::vector<Vector2d>& along) {
    std::vector<Vector2d> zigzag;
    const double half = thickness(instrument_.outer_diameter_m) / 2;
    for (std::size_t k = 0; k + 1 < along.size(); ++k) {
      const Vector2d tangent = (along[k + 1] - along[k]).normalized();
      zigzag.push_back(along[k] + (k % 2 ? half : -half) * Vector2d(-tangent.y(), tangent.x()));
    }
    drawing_.line(zigzag, "#222", 0.25);
  }

  void draw_scale_bar() {
    const double length_mm = scale_ > 2 ? 5 : 10, bar = length_mm * scale_;
    const Vector2d at = corner_ + Vector2d(cell_width - 3 - bar, shape_top + shape_height - 1);
    drawing_.line({at, at + Vector2d(bar, 0)}, "#222", 0.4);
    for (double end : {0.0, bar}) drawing_.line({at + Vector2d(end, -0.8), at + Vector2d(end, 0.8)}, "#222", 0.4);
    drawing_.text(at + Vector2d(0, -1.5), fmt::format("{:g} mm", length_mm), 2.2);
  }

  void draw_strip() {
    const Vector2d at = corner_ + Vector2d(2, shape_top + shape_height + 3);
    const double width = cell_width - 6;
    for (const core::Section& s : instrument_.sections) {
      const double a = std::min(s.from_tip_m, strip_length_m), b = std::min(s.to_tip_m, strip_length_m);
      if (b > a)
        drawing_.rectangle(at + Vector2d(a / strip_length_m * width, 0), {(b - a) / strip_length_m * width, 2},
                           colour_of(EI_Nmm2(s)));
    }
    drawing_.text(at + Vector2d(0, 4.8),
                  fmt::format("EI {:.3g} (tip) to {:.4g} N mm\u00b2", EI_Nmm2(instrument_.sections.front()),
                              EI_Nmm2(instrument_.sections.back())),
                  2.2);
  }

  Drawing& drawing_;
  const Instrument& instrument_;
  Vector2d corner_;
  double scale_, shown_mm_ = 0;
  std::vector<Vector2d> points_;
};

void draw_legend(Drawing& drawing) {
  drawing.text({margin + 2, 7}, "Instruments at rest, distal end, shaft from above", 4.5);
  drawing.text({margin + 2, 12},
               "thickness to scale where it can be seen; black core: platinum or tungsten; black band: marker; "
               "bar below: the distal 40 cm, tip on the left",
               2.6);
  drawing.text({margin + 2, 18}, "bending stiffness, N mm\u00b2:", 2.6);
  double x = margin + 40;
  for (double EI : {0.2, 1.0, 5.0, 20.0, 100.0, 400.0, 2000.0}) {
    drawing.rectangle({x, 15.5}, {6, 3}, colour_of(EI));
    drawing.text({x + 7, 18}, fmt::format("{:g}", EI), 2.6);
    x += 17;
  }
}

}  // namespace

void draw_instruments(const std::vector<Instrument>& instruments, const std::string& file) {
  const int count = static_cast<int>(instruments.size()), across = std::min(count, columns);
  const int rows = (count + columns - 1) / columns;
  Drawing drawing(2 * margin + std::max(across, 4) * cell_width, heading + rows * cell_height + margin);
  draw_legend(drawing);
  // Grouped as in catalogues: guides, then diagnostic catheters, wires, shafts.
  std::vector<const Instrument*> order;
  const auto rank = [](const Instrument& i) {
    if (i.kind == InstrumentKind::guide_catheter) return 0;
    if (i.kind == InstrumentKind::diagnostic_catheter) return i.shape.size() > 2 ? 1 : 2;
    if (i.kind == InstrumentKind::sheath) return 3;
    if (i.kind != InstrumentKind::wire) return 6;
    return i.outer_diameter_m > 0.5e-3 ? 4 : 5;
  };
  for (const Instrument& instrument : instruments) order.push_back(&instrument);
  std::stable_sort(order.begin(), order.end(),
                   [&](const Instrument* a, const Instrument* b) { return rank(*a) < rank(*b); });
  for (int k = 0; k < count; ++k) {
    const int row = k / columns, column = k % columns;
    Cell(drawing, *order[k], Vector2d(margin + column * cell_width, heading + row * cell_height)).draw();
  }
  drawing.write(file);
}

}  // namespace ostium::data
