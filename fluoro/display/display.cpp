#include "fluoro/display/display.h"

#include <algorithm>
#include <cmath>

#include "fluoro/base/lanes.h"
#include "fluoro/base/resample.h"

namespace ostium::fluoro {

namespace {

using Row = Eigen::Array<float, 1, Eigen::Dynamic>;

/// Mean over the exposed area, weighted by `exposed`.
float mean_over(const Plane& plane, const Plane& exposed) {
  const float sum = exposed.sum();
  return sum > 0 ? (plane * exposed).sum() / sum : 0;
}

}  // namespace

void display(const Plane& signal, const Plane& exposed, double field_m, const DisplaySettings& settings,
             DisplayScratch& scratch, Picture& out) {
  const int pixels = static_cast<int>(signal.rows());
  const int cells = std::max(1, pixels / 8);
  const float floor = 1e-4f * std::max(signal.maxCoeff(), 1e-30f);
  Plane& smooth = scratch.smooth;
  smooth = signal;
  gaussian_blur(smooth, settings.smooth_m / field_m * pixels, Beyond::same, scratch.blurred);
  const bool open = exposed.minCoeff() >= 1;
  Plane &logarithms = scratch.logarithm, &slow = scratch.slow;
  logarithms.resize(pixels, pixels);
  for (int i = 0; i < pixels * pixels; i += lanes) {
    const int here = std::min(lanes, pixels * pixels - i);
    Floats level = load(smooth.data() + i, here);
    // The shutters' shadow is excluded, or its edge would ring in the low frequencies.
    if (!open) level /= most(load(exposed.data() + i, here), all(0.02f));
    store(logarithm(most(level, all(floor))), logarithms.data() + i, here);
  }
  Plane coarse = block_means(logarithms, cells);
  const float mean = mean_over(coarse, block_means(exposed, cells));
  gaussian_blur(coarse, settings.slow_m / field_m * cells, Beyond::same, scratch.blurred);
  enlarge(coarse, pixels, slow);

  const auto share = static_cast<float>(settings.compression), gamma = static_cast<float>(settings.gamma);
  const float middle = std::log(static_cast<float>(settings.mean_level));
  out.width = out.height = pixels;
  out.grey.resize(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(pixels));
  const float at = middle - gamma * (1 - share) * mean;
  Row level(pixels);
  for (int row = 0; row < pixels; ++row) {
    const float *const logarithm_ = logarithms.row(row).data(), *const slow_ = slow.row(row).data();
    for (int column = 0; column < pixels; column += lanes) {
      const int here = std::min(lanes, pixels - column);
      store(exponential(at + gamma * (load(logarithm_ + column, here) - share * load(slow_ + column, here))),
            level.data() + column, here);
    }
    // x / (1 + x^4)^(1/4) has slope 1 at black and approaches white asymptotically.
    level /= (1 + level.square().square()).sqrt().sqrt();
    if (!open) level *= exposed.row(row).min(1.0f);
    std::uint8_t* grey = out.grey.data() + std::size_t(row) * std::size_t(pixels);
    for (int column = 0; column < pixels; ++column)
      grey[column] = static_cast<std::uint8_t>(static_cast<int>(255 * level[column] + 0.5f));
  }
}

}  // namespace ostium::fluoro
