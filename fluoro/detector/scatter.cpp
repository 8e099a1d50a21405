#include "fluoro/detector/scatter.h"

#include "fluoro/base/resample.h"

namespace ostium::fluoro {

void scatter(const ScatterInput& in, const ScatterKernel& kernel, Plane& out) {
  constexpr int cells = 32;
  const double cell_m = in.field_m / cells;
  const Plane primary = block_means(in.primary, cells);
  const auto open = static_cast<float>(in.open);
  const Plane thickness_m = ((open / primary.max(1e-9f * open)).log() / static_cast<float>(in.soft_1_m)).max(0.0f);
  Plane narrow =
      primary * thickness_m * (static_cast<float>(kernel.per_m) + static_cast<float>(kernel.per_m2) * thickness_m);
  Plane wide = narrow * static_cast<float>(1 - kernel.narrow_share);
  narrow *= static_cast<float>(kernel.narrow_share);
  Plane scratch;
  gaussian_blur(narrow, kernel.narrow_m / cell_m, Beyond::zero, scratch);
  gaussian_blur(wide, kernel.wide_m / cell_m, Beyond::zero, scratch);
  enlarge(narrow + wide, in.primary.rows(), out);
}

}  // namespace ostium::fluoro
