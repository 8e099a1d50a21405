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

Leak find_leak(const PathLengths& lengths) {
  const auto leaks = lengths.soft_m() < leak_m || lengths.bone_m() < leak_m ||
                     lengths.iodine_kg_m2() < leak_m * leak_iodine_kg_m3 || lengths.unmatched() != 0;
  Leak leak;
  leak.pixels = leaks.count();
  if (leak)
    leak.worst_m = std::min({0.0f, lengths.soft_m().minCoeff(), lengths.bone_m().minCoeff(),
                             lengths.iodine_kg_m2().minCoeff() / leak_iodine_kg_m3});
  return leak;
}

std::unique_ptr<PathLengthRenderer> make_renderer(Renderer which) {
  return which == Renderer::osmesa ? make_osmesa_renderer()
         : which == Renderer::egl  ? make_egl_renderer()
                                   : make_scanline_renderer();
}

}  // namespace ostium::fluoro
