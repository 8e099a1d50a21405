#include "data/formats/svg.h"

#include <fmt/format.h>

#include "data/formats/markup.h"
#include "data/formats/write_file.h"

namespace ostium::data {

void Drawing::line(const std::vector<Eigen::Vector2d>& points_mm, const std::string& colour, double thickness_mm,
                   bool round_ends) {
  body_ += "<polyline points=\"";
  for (const Eigen::Vector2d& p : points_mm) body_ += fmt::format("{:.2f},{:.2f} ", p.x(), p.y());
  body_ += fmt::format("\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n", colour, thickness_mm,
                       round_ends ? "" : " stroke-linecap=\"butt\"");
}

void Drawing::cross(const Eigen::Vector2d& at_mm, const std::string& colour) {
  for (const Eigen::Vector2d& arm : {Eigen::Vector2d(1.5, 1.5), Eigen::Vector2d(1.5, -1.5)})
    line({at_mm - arm, at_mm + arm}, colour, 0.6);
}

void Drawing::text(const Eigen::Vector2d& at_mm, const std::string& words, double size_mm) {
  body_ += fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" font-family=\"sans-serif\" fill=\"#222\" "
      "stroke=\"none\">{}</text>\n",
      at_mm.x(), at_mm.y(), size_mm, escaped(words));
}

void Drawing::rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, const std::string& colour) {
  body_ += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", corner.x(),
                       corner.y(), size.x(), size.y(), colour);
}

void Drawing::write(const std::string& path) const {
  write_file(path, fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" "
                               "viewBox=\"0 0 {0} {1}\" fill=\"none\" stroke-linecap=\"round\" "
                               "stroke-linejoin=\"round\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
                               "{2}</svg>\n",
                               width_, height_, body_));
}

}  // namespace ostium::data
