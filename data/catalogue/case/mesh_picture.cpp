#include "data/catalogue/case/mesh_picture.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "data/formats/load_error.h"
#include "data/formats/markup.h"
#include "data/formats/png.h"
#include "data/formats/write_file.h"
#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::data {

namespace {

constexpr int margin_px = 20, longest_px = 900;

/// The mesh axes that point right, up and towards the viewer.
struct View {
  int right, up, towards;
  double right_sign;
  const char* name;
};
constexpr View views[] = {{0, 1, 2, 1, "against z"}, {2, 1, 0, -1, "against x"}, {0, 2, 1, 1, "against -y"}};

struct Image {
  int width = 0, height = 0;
  std::vector<float> depth;
  std::vector<unsigned char> rgb;
  void paint(int x, int y, const Eigen::Vector3d& colour) {
    if (x < 0 || y < 0 || x >= width || y >= height) return;
    for (int k = 0; k < 3; ++k)
      rgb[3 * (y * width + x) + k] = static_cast<unsigned char>(std::clamp(colour[k], 0., 255.));
  }
};

class Drawer {
 public:
  Drawer(const vascular::Mesh& mesh, const std::vector<Eigen::Vector3d>& colours) : mesh_(mesh), colours_(colours) {
    for (const Eigen::Vector3d& p : mesh.vertices) box_.extend(p);
    const Eigen::Vector3d size = box_.sizes();
    scale_ = longest_px / std::max({size.x() + size.z() + size.x(), size.y(), size.z(), 1e-9});
    scale_ = std::min(scale_, longest_px / std::max(size.y(), 1e-9));
    int x = margin_px;
    for (const View& view : views) {
      left_.push_back(x);
      x += static_cast<int>(scale_ * size[view.right]) + 2 * margin_px;
      image_.height = std::max(image_.height, static_cast<int>(scale_ * size[view.up]) + 2 * margin_px);
    }
    image_.width = x;
    image_.depth.assign(static_cast<std::size_t>(image_.width * image_.height),
                        -std::numeric_limits<float>::infinity());
    image_.rgb.assign(3 * image_.depth.size(), 255);
    for (std::size_t v = 0; v < std::size(views); ++v) draw(v);
  }

  /// x, y in pixels, and the depth towards the viewer.
  Eigen::Vector3d seen(std::size_t v, const Eigen::Vector3d& p) const {
    const View& view = views[v];
    const double right =
        view.right_sign > 0 ? p[view.right] - box_.min()[view.right] : box_.max()[view.right] - p[view.right];
    // Seen from below, with the front up, as in an axial CT slice.
    const double towards = v == 2 ? -p[view.towards] : p[view.towards];
    return {left_[v] + scale_ * right, margin_px + scale_ * (box_.max()[view.up] - p[view.up]), towards};
  }

  Image& image() { return image_; }
  int left(std::size_t v) const { return left_[v]; }

 private:
  void draw(std::size_t v) {
    for (const auto& [i, j, k] : mesh_.triangles) {
      const Eigen::Vector3d a = seen(v, mesh_.vertices[i]), b = seen(v, mesh_.vertices[j]),
                            c = seen(v, mesh_.vertices[k]);
      const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
      if (std::fabs(area) < 1e-12) continue;
      const Eigen::Vector3d n =
          (mesh_.vertices[j] - mesh_.vertices[i]).cross(mesh_.vertices[k] - mesh_.vertices[i]).normalized();
      const double light = 0.35 + 0.65 * std::fabs(n[views[v].towards]);
      const int x0 = static_cast<int>(std::floor(std::min({a.x(), b.x(), c.x()}))),
                x1 = static_cast<int>(std::ceil(std::max({a.x(), b.x(), c.x()})));
      const int y0 = static_cast<int>(std::floor(std::min({a.y(), b.y(), c.y()}))),
                y1 = static_cast<int>(std::ceil(std::max({a.y(), b.y(), c.y()})));
      for (int y = std::max(0, y0); y <= std::min(image_.height - 1, y1); ++y)
        for (int x = std::max(0, x0); x <= std::min(image_.width - 1, x1); ++x) {
          const double u = ((b.x() - x) * (c.y() - y) - (b.y() - y) * (c.x() - x)) / area;
          const double w = ((c.x() - x) * (a.y() - y) - (c.y() - y) * (a.x() - x)) / area;
          if (u < 0 || w < 0 || u + w > 1) continue;
          const float depth = static_cast<float>(u * a.z() + w * b.z() + (1 - u - w) * c.z());
          float& old = image_.depth[static_cast<std::size_t>(y * image_.width + x)];
          if (depth <= old) continue;
          old = depth;
          image_.paint(x, y, light * (u * colours_[i] + w * colours_[j] + (1 - u - w) * colours_[k]));
        }
    }
  }

  const vascular::Mesh& mesh_;
  const std::vector<Eigen::Vector3d>& colours_;
  Eigen::AlignedBox3d box_;
  double scale_ = 1;
  std::vector<int> left_;
  Image image_;
};

}  // namespace

void draw_mesh(const std::string& file, const vascular::Mesh& mesh, const std::vector<Eigen::Vector3d>& rgb_of_vertex,
               const std::vector<PictureMark>& marks, const std::string& title) {
  const bool svg = vascular::ending_of(file) == ".svg";
  if (!svg && vascular::ending_of(file) != ".png")
    throw LoadError(file + ": what is it to be? .png and .svg are known");
  Drawer drawer(mesh, rgb_of_vertex);
  Image& image = drawer.image();
  if (!svg) {
    for (const PictureMark& mark : marks)
      for (std::size_t v = 0; v < std::size(views); ++v) {
        const Eigen::Vector3d at = drawer.seen(v, mark.p);
        for (int y = -4; y <= 4; ++y)
          for (int x = -4; x <= 4; ++x)
            if (const int r2 = x * x + y * y; r2 <= 17 && r2 >= 6)
              image.paint(static_cast<int>(at.x()) + x, static_cast<int>(at.y()) + y, mark.rgb);
      }
    write_rgb_png(file, image.width, image.height, image.rgb);
    return;
  }
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 -30 {0} {1}\" "
      "font-family=\"sans-serif\" font-size=\"11\">\n<rect y=\"-30\" width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n"
      "<image width=\"{0}\" height=\"{2}\" href=\"{3}\"/>\n"
      "<text x=\"{4}\" y=\"-12\" font-size=\"13\">{5}</text>\n",
      image.width, image.height + 30, image.height, data_uri(rgb_png_of(image.width, image.height, image.rgb)),
      margin_px, escaped(title));
  for (std::size_t v = 0; v < std::size(views); ++v)
    text += fmt::format("<text x=\"{}\" y=\"10\" fill=\"#666\">{}</text>\n", drawer.left(v), views[v].name);
  for (const PictureMark& mark : marks)
    for (std::size_t v = 0; v < std::size(views); ++v) {
      const Eigen::Vector3d at = drawer.seen(v, mark.p);
      const std::string colour = fmt::format("rgb({:.0f},{:.0f},{:.0f})", mark.rgb.x(), mark.rgb.y(), mark.rgb.z());
      text += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n", at.x(),
          at.y(), colour);
      if (v == 0 && !mark.words.empty())
        text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\">{}</text>\n", at.x() + 6, at.y() + 4, colour,
                            escaped(mark.words));
    }
  write_file(file, text + "</svg>\n");
}

}  // namespace ostium::data
