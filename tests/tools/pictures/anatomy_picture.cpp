/// Draws people's coronary arteries in the views of a catheter laboratory, shaded, for the README of vascular.
///   anatomy_picture FILE.png [seed ...]       a row of eight views for each person (seed 0: the mean), and the front
#include <png.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include "core/base/units.h"
#include "fluoro/projection/c_arm.h"
#include "vascular/patient/patient.h"

namespace {

using namespace ostium;

using units::degree;
constexpr int tile = 300;

struct View {
  double lao_deg, cran_deg, field_m;
};

// Front, left: AP/CAU 30, RAO 20/CAU 25, RAO 10/CRA 40, LAO 45/CRA 25, spider; right: LAO 40, RAO 30, AP/CRA 30.
constexpr View views[] = {{0, 0, 0.17},    {0, -30, 0.15}, {-20, -25, 0.15}, {-10, 40, 0.15}, {45, 25, 0.15},
                          {45, -30, 0.15}, {40, 0, 0.15},  {-30, 0, 0.15},   {0, 30, 0.15}};
constexpr int columns = static_cast<int>(std::size(views));

struct Image {
  int width, height;
  std::vector<float> depth;
  std::vector<unsigned char> rgb;
  Image(int w, int h)
      : width(w), height(h), depth(w * h, std::numeric_limits<float>::infinity()), rgb(3 * w * h, 252) {}
};

/// Left red, right blue, the rest grey.
Eigen::Vector3d colour(const vascular::Anatomy& anatomy, const std::vector<vascular::TubeShare>& shares) {
  const int left = find_branch(anatomy, "LM")->tube, right = find_branch(anatomy, "RCA")->tube;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const vascular::TubeShare& share : shares) {
    int t = share.tube;
    while (t != left && t != right && t > 0) t = anatomy.tubes[t].parent;
    sum += share.weight * (t == left    ? Eigen::Vector3d(196, 52, 46)
                           : t == right ? Eigen::Vector3d(48, 92, 186)
                                        : Eigen::Vector3d(196, 192, 186));
  }
  return sum;
}

void draw(Image& image, int x0, int y0, const vascular::Mesh& mesh, const std::vector<Eigen::Vector3d>& colours,
          const View& view) {
  fluoro::CArm arm{.lao_rad = view.lao_deg * degree, .cran_rad = view.cran_deg * degree};
  arm.p_PI = Eigen::Vector3d(0.008, -0.04, 0.022);
  const Eigen::Vector3d focus = source(arm), towards = fluoro::towards_detector(arm);
  std::vector<Eigen::Vector3d> seen;  // pixel, and distance from the detector's side
  for (const Eigen::Vector3d& p : mesh.vertices) {
    const auto uv = project(arm, p);
    const double scale = tile / view.field_m / (arm.source_to_detector_m / arm.source_to_isocentre_m);
    seen.push_back(
        uv ? Eigen::Vector3d(tile / 2.0 + uv->x() * scale, tile / 2.0 - uv->y() * scale, -(p - focus).dot(towards))
           : Eigen::Vector3d::Constant(1e9));
  }
  for (const auto& [i, j, k] : mesh.triangles) {
    const Eigen::Vector3d &a = seen[i], &b = seen[j], &c = seen[k];
    const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    if (std::fabs(area) < 1e-12) continue;
    const Eigen::Vector3d n =
        (mesh.vertices[j] - mesh.vertices[i]).cross(mesh.vertices[k] - mesh.vertices[i]).normalized();
    const double light = 0.3 + 0.7 * std::fabs(n.dot(towards));
    const auto bounds = [&](int axis) {
      const double low = std::min({a[axis], b[axis], c[axis]}), high = std::max({a[axis], b[axis], c[axis]});
      return std::pair(std::max(0, static_cast<int>(std::floor(low))),
                       std::min(tile - 1, static_cast<int>(std::ceil(high))));
    };
    const auto [xa, xb] = bounds(0);
    const auto [ya, yb] = bounds(1);
    for (int y = ya; y <= yb; ++y)
      for (int x = xa; x <= xb; ++x) {
        const double u = ((b.x() - x) * (c.y() - y) - (b.y() - y) * (c.x() - x)) / area;
        const double v = ((c.x() - x) * (a.y() - y) - (c.y() - y) * (a.x() - x)) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        const float depth = static_cast<float>(u * a.z() + v * b.z() + (1 - u - v) * c.z());
        const int pixel = (y0 + y) * image.width + x0 + x;
        if (depth >= image.depth[pixel]) continue;
        image.depth[pixel] = depth;
        const double fog = std::clamp(1 - (depth + 0.86) * 4, 0.3, 1.0);
        const Eigen::Vector3d rgb = fog * light * (u * colours[i] + v * colours[j] + (1 - u - v) * colours[k]) +
                                    (1 - fog) * Eigen::Vector3d::Constant(235);
        for (int q = 0; q < 3; ++q) image.rgb[3 * pixel + q] = static_cast<unsigned char>(rgb[q]);
      }
  }
}

bool write(const char* file, const Image& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  return png_image_write_to_file(&png, file, 0, image.rgb.data(), 0, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  std::vector<std::uint64_t> seeds;
  for (int i = 2; i < argc; ++i) seeds.push_back(std::strtoull(argv[i], nullptr, 10));
  if (seeds.empty()) seeds = {0, 1, 2, 3};
  Image image(columns * tile, static_cast<int>(seeds.size()) * tile);
  for (std::size_t row = 0; row < seeds.size(); ++row) {
    const vascular::Patient patient = vascular::make_patient(vascular::person(seeds[row], {}), {});
    const vascular::Mesh mesh = patient.lumen.at(0.75, 0);
    std::vector<Eigen::Vector3d> colours;
    for (const auto& shares : patient.lumen.shares) colours.push_back(colour(patient.anatomy, shares));
    for (int v = 0; v < columns; ++v) draw(image, v * tile, static_cast<int>(row) * tile, mesh, colours, views[v]);
  }
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (x % tile == 0 || y % tile == 0) std::fill_n(&image.rgb[3 * (y * image.width + x)], 3, 200);
  if (write(argv[1], image)) return 0;
  std::fprintf(stderr, "%s: cannot be written\n", argv[1]);
  return 1;
}
