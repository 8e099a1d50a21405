#include "data/formats/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/formats/markup.h"

namespace ostium::data {

namespace {

constexpr double left = 52, right = 12, top = 26, bottom = 40, small = 10.5;

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void take(double v) {
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  }
  void finish(double margin) {
    if (!(high >= low)) low = 0, high = 1;
    if (high - low < 1e-9 * std::max(1.0, std::fabs(high))) low -= 0.5, high += 0.5;
    const double pad = margin * (high - low);
    if (low != 0) low -= pad;
    if (high != 0) high += pad;
  }
};

/// 1, 2 or 5 times a power of ten, giving about five ticks.
double tick_step(const Range& r) {
  const double rough = (r.high - r.low) / 5, power = std::pow(10, std::floor(std::log10(rough)));
  for (double m : {1.0, 2.0, 5.0})
    if (rough <= m * power) return m * power;
  return 10 * power;
}

std::string text(double x, double y, const std::string& words, const char* anchor, double size = small,
                 const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, size,
                     anchor, more, escaped(words));
}

}  // namespace

Plot::Plot(std::string title, std::string x_label, std::string y_label, double width, double height)
    : title_(std::move(title)),
      x_label_(std::move(x_label)),
      y_label_(std::move(y_label)),
      width_(width),
      height_(height) {}

void Plot::line(const Points& points, const std::string& colour, double width, const std::string& dashes) {
  items_.push_back({points, colour, dashes, width, false});
}
void Plot::dots(const Points& points, const std::string& colour, double radius) {
  items_.push_back({points, colour, "", radius, true});
}
void Plot::level(double y, const std::string& words) { levels_.emplace_back(y, words); }
void Plot::bars(const std::vector<std::string>& names, const std::vector<std::vector<double>>& series,
                const std::vector<std::string>& colours) {
  bar_names_ = names, bar_values_ = series, bar_colours_ = colours;
}
void Plot::legend(const std::string& words, const std::string& colour, bool dot, const std::string& dashes) {
  legend_.push_back({words, colour, dashes, dot});
}

std::string Plot::svg() const {
  Range x, y;
  for (const Item& item : items_)
    for (const Eigen::Vector2d& p : item.points) x.take(p.x()), y.take(p.y());
  for (const auto& [value, words] : levels_) y.take(value);
  for (const Eigen::Vector2d& p : include_) x.take(p.x()), y.take(p.y());
  for (const auto& series : bar_values_)
    for (double v : series) y.take(v), y.take(0);
  if (!bar_names_.empty()) x.take(0), x.take(static_cast<double>(bar_names_.size()));
  x.finish(bar_names_.empty() ? 0.04 : 0), y.finish(0.06);

  const double wide = width_ - left - right, high = height_ - top - bottom;
  if (equal_) {
    const double scale = std::min(wide / (x.high - x.low), high / (y.high - y.low));
    const double more_x = wide / scale - (x.high - x.low), more_y = high / scale - (y.high - y.low);
    x.low -= more_x / 2, x.high += more_x / 2, y.low -= more_y / 2, y.high += more_y / 2;
  }
  const auto px = [&](double v) { return left + wide * (v - x.low) / (x.high - x.low); };
  const auto py = [&](double v) { return top + high * (downwards_ ? v - y.low : y.high - v) / (y.high - y.low); };

  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" fill=\"#222\">\n",
      width_, height_);
  out += text(left, 15, title_, "start", 12.5, " font-weight=\"bold\"");
  const auto grid = [&](double x1, double y1, double x2, double y2, const char* colour) {
    out += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2, y2, colour);
  };
  for (double step = tick_step(y), v = std::ceil(y.low / step) * step; v <= y.high + 1e-9 * step; v += step) {
    grid(left, py(v), left + wide, py(v), std::fabs(v) < 1e-9 * step ? "#aaa" : "#e6e6e6");
    out += text(left - 5, py(v) + 3.5, fmt::format("{:g}", std::fabs(v) < 1e-9 * step ? 0.0 : v), "end");
  }
  if (bar_names_.empty())
    for (double step = tick_step(x), v = std::ceil(x.low / step) * step; v <= x.high + 1e-9 * step; v += step) {
      grid(px(v), top, px(v), top + high, "#e6e6e6");
      out += text(px(v), top + high + 13, fmt::format("{:g}", std::fabs(v) < 1e-9 * step ? 0.0 : v), "middle");
    }
  for (std::size_t s = 0; s < bar_values_.size(); ++s)
    for (std::size_t i = 0; i < bar_values_[s].size(); ++i) {
      const double w = 0.8 / static_cast<double>(bar_values_.size()),
                   from = static_cast<double>(i) + 0.1 + w * static_cast<double>(s);
      out +=
          fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", px(from),
                      py(bar_values_[s][i]), px(from + w) - px(from), py(0) - py(bar_values_[s][i]), bar_colours_[s]);
    }
  const std::size_t every = 1 + bar_names_.size() / 28;
  for (std::size_t i = 0; i < bar_names_.size(); i += every) {
    const double at = px(static_cast<double>(i) + 0.5) + 3;
    out += text(at, top + high + 6, bar_names_[i].substr(0, 14), "end", bar_names_.size() > 12 ? 7.5 : 9,
                fmt::format(" transform=\"rotate(-45 {:.1f} {:.1f})\"", at, top + high + 6));
  }
  for (const Item& item : items_) {
    if (item.dots) {
      for (const Eigen::Vector2d& p : item.points)
        out += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" fill=\"{}\"/>\n", px(p.x()), py(p.y()),
                           item.size, item.colour);
      continue;
    }
    out += "<polyline fill=\"none\" points=\"";
    for (const Eigen::Vector2d& p : item.points) out += fmt::format("{:.2f},{:.2f} ", px(p.x()), py(p.y()));
    out += fmt::format("\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n", item.colour, item.size,
                       item.dashes.empty() ? "" : " stroke-dasharray=\"" + item.dashes + "\"");
  }
  for (const auto& [value, words] : levels_) {
    out += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#555\" stroke-dasharray=\"2 3\"/>\n", left,
                       py(value), left + wide);
    out += text(left + wide, py(value) - 3, words, "end", 9.5);
  }
  out += text(left + wide / 2, height_ - 5, x_label_, "middle");
  out += text(12, top + high / 2, y_label_, "middle", small,
              fmt::format(" transform=\"rotate(-90 12 {:.1f})\"", top + high / 2));
  double at = left + wide;
  for (auto entry = legend_.rbegin(); entry != legend_.rend(); ++entry) {
    at -= 5.6 * static_cast<double>(entry->words.size());
    out += text(at, 15, entry->words, "start", 10);
    if (entry->dot)
      out += fmt::format("<circle cx=\"{:.1f}\" cy=\"11.5\" r=\"2.6\" fill=\"{}\"/>\n", at - 7, entry->colour);
    else
      out += fmt::format("<path d=\"M{:.1f} 11.5h14\" stroke=\"{}\" stroke-width=\"2\"{}/>\n", at - 17, entry->colour,
                         entry->dashes.empty() ? "" : " stroke-dasharray=\"" + entry->dashes + "\"");
    at -= 26;
  }
  return out + "</svg>\n";
}

}  // namespace ostium::data
