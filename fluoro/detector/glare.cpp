#include "fluoro/detector/glare.h"

#include "fluoro/base/resample.h"

namespace ostium::fluoro {

void add_glare(const GlareKernel& kernel, double field_m, Plane& signal, Plane& scratch) {
  if (!(kernel.share > 0)) return;
  constexpr int cells = 32;  // of 6 mm: glare is smooth
  Plane veil = block_means(signal, cells) * static_cast<float>(kernel.share);
  gaussian_blur(veil, kernel.spread_m / field_m * cells, Beyond::zero, scratch);
  enlarge(veil, signal.rows(), scratch);
  signal = static_cast<float>(1 - kernel.share) * signal + scratch;
}

}  // namespace ostium::fluoro
