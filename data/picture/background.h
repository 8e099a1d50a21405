#pragma once
/// What lies behind the vessels: anatomy, grain, and the collimator's edges.
#include "data/picture/image.h"

namespace ostium::data {

struct Background {
  double grad_median_rel = 0;       ///< median gradient at 2 px, % of the 5 to 95 % spread a pixel
  double grad_p99_over_median = 0;  ///< how much its sharpest edges stand out
  double texture_ratio = 0;         ///< detail of 4 to 8 px against 16 to 32 px, robust deviations
  double band32_mad = 0;            ///< grey levels of the latter
  double psd_slope_noise = 0;       ///< of the power spectrum, 0.2 to 0.45 cycles a pixel, log-log
};
/// `look`: pixels that count; `vessels`: filled in from around them.
Background measure_background(const Image& image, const Mask& vessels, const Mask& inner);

struct Grain {
  bool enough = false;               ///< at least 12 blocks of 24 x 24 free of vessels
  double noise_rel = 0;              ///< deviation under 3 px in flat blocks, % of their grey
  double grain = 0;                  ///< its correlation with the next pixel
  double noise_dark_over_light = 0;  ///< finest grain of the darkest third of blocks against the lightest
};
/// `look`: inner pixels without vessels.
Grain measure_grain(const Image& image, const Mask& look);

/// Vessels replaced by what surrounds them.
Image without_vessels(const Image& image, const Mask& vessels);

/// Sides on which a collimator's edge shows: the outermost three lines are under 0.72 of what is further in.
int border_sides(const Image& image);

}  // namespace ostium::data
