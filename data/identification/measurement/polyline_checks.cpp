#include "data/identification/measurement/polyline_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace ostium::data {

namespace {

using Eigen::Vector2d;
using units::mm;

/// A click lies in the picture; noise that was added to it may carry it a little beyond.
constexpr double beyond_px = 10;
/// Of the picture's width: a first click nearer to the base than `near` is at it, one farther than `far` is not.
constexpr double near = 0.03, far = 0.1;
constexpr double longer = 1.1;             // than the wire can appear
constexpr double least_depth_m = 50 * mm;  // of a wire before the source, for how large it can appear

std::string in_words(const Vector2d& px) { return fmt::format("[{:.4g}, {:.4g}]", px.x(), px.y()); }

/// What the numbers might be instead, if so taken the first of them would lie at the base.
std::string other_meaning(const Camera& c, const Vector2d& first, const Vector2d& base) {
  const double pixel_mm = c.pixel_m / mm;
  const Vector2d middle = c.middle_px(), from_top(first.x(), c.rows - 1 - first.y());
  const std::pair<Vector2d, const char*> taken[] = {
      {first / pixel_mm, "are these mm on the detector?"},
      {first / pixel_mm + middle, "are these mm on the detector from its middle?"},
      {1e3 * first / pixel_mm, "are these metres?"},
      {1e3 * first / pixel_mm + middle, "are these metres from the middle?"},
      {{first.y(), first.x()}, "is this [row, column]?"},
      {from_top, "are rows counted from the other side?"},
      {{c.columns - 1 - first.x(), first.y()}, "are columns counted from the other side?"}};
  for (const auto& [as, question] : taken)
    if ((as - base).norm() < near * c.columns) return question;
  return "";
}

/// How long a wire inserted this far can appear at most, px.
double longest_px(const Camera& c, const Experiment& e) {
  const double inserted = e.set.back().inserted_m, depth = c.outwards().dot(e.base.p_W - c.source_m);
  return inserted * c.source_to_detector_m() / std::max(depth - inserted, least_depth_m) / c.pixel_m;
}

}  // namespace

std::string doubt_of(const MeasuredCArm& view, const Experiment& e, const ClickedPolyline& polyline,
                     std::optional<std::size_t>& point) {
  const Camera& c = view.camera;
  const std::vector<Vector2d>& clicked = polyline.points_px;
  const Vector2d base = c(e.base.p_W);
  if (!base.allFinite())
    return fmt::format("the base lies behind the source of view \"{}\"; expected both in one frame, in mm", view.id);
  const double from_base = (clicked.front() - base).norm() / c.columns;
  const std::string meaning = from_base > far ? other_meaning(c, clicked.front(), base) : "";
  for (std::size_t i = 0; i < clicked.size(); ++i)
    if (!(clicked[i].x() >= -beyond_px && clicked[i].x() <= c.columns - 1 + beyond_px && clicked[i].y() >= -beyond_px &&
          clicked[i].y() <= c.rows - 1 + beyond_px)) {
      point = i;
      return fmt::format("expected a pixel of the picture, [0, 0] to [{}, {}]{}", c.columns - 1, c.rows - 1,
                         meaning.empty() ? "" : "; " + meaning);
    }
  if (!meaning.empty())
    return fmt::format("it begins at {}, and view \"{}\" sees the base at {}; {}", in_words(clicked.front()), view.id,
                       in_words(base), meaning);
  if (from_base > far && (clicked.back() - base).norm() < near * c.columns)
    return fmt::format("it ends where view \"{}\" sees the base, at {}; expected it from base to tip", view.id,
                       in_words(base));
  double reach = 0;
  for (const Vector2d& p : clicked) reach = std::max(reach, (p - clicked.front()).norm());
  if (reach > longer * longest_px(c, e))
    return fmt::format(
        "it reaches {:.4g} px from its first point, and {:g} mm of wire can appear {:.4g} px long; is "
        "inserted_length_mm in mm?",
        reach, e.set.back().inserted_m / mm, longest_px(c, e));
  return "";
}

}  // namespace ostium::data
