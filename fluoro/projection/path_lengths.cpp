#include "fluoro/projection/path_lengths.h"

#include <algorithm>
#include <cmath>

namespace ostium::fluoro {

Plane ray_stretch(const View& view) {
  const Eigen::ArrayXd across = ((Eigen::ArrayXd::LinSpaced(view.pixels, 0.5, view.pixels - 0.5) / view.pixels - 0.5) *
                                 view.field_m / view.arm.source_to_detector_m)
                                    .square();
  Plane out(view.pixels, view.pixels);
  for (int row = 0; row < view.pixels; ++row) out.row(row) = (1 + across[row] + across).sqrt().cast<float>();
  return out;
}

PathLengths::PathLengths(int pixels) : side_(pixels), pixels_(Pixels::Zero(4, Eigen::Index(pixels) * pixels)) {}

Leak find_leak(const PathLengths& lengths) {
  const Eigen::Array4f limit(leak_m, leak_m, leak_m * leak_iodine_kg_m3, 0);
  Eigen::Array4f least = Eigen::Array4f::Zero();
  float most_unmatched = 0;
  for (const auto& pixel : lengths.pixels().colwise()) {
    least = least.min(pixel);
    most_unmatched = std::max(most_unmatched, std::fabs(pixel[3]));
  }
  Leak leak;
  if (!((least < limit).any() || most_unmatched > 0)) return leak;  // the usual case
  leak.worst_m = std::min({least[0], least[1], least[2] / leak_iodine_kg_m3});
  for (const auto& pixel : lengths.pixels().colwise())
    if ((pixel < limit).any() || pixel[3] != 0) ++leak.pixels;
  return leak;
}

std::unique_ptr<PathLengthRenderer> make_renderer(Renderer which) {
  return which == Renderer::osmesa ? make_osmesa_renderer()
         : which == Renderer::egl  ? make_egl_renderer()
                                   : make_scanline_renderer();
}

}  // namespace ostium::fluoro
