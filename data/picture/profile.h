#pragma once
/// A profile across a vessel, and what is read from it.
#include "data/picture/vessels.h"

namespace ostium::data {

/// Grey levels at offsets from -half to half, every half pixel, averaged over 7 pixels along the vessel.
struct Across {
  std::vector<double> offset_px, grey;
};
Across across(const Image& image, const Eigen::Vector2d& at_yx, const Eigen::Vector2d& along_yx, double half_px);

/// Empty where there is no clean vessel: too faint, on a slope, lopsided or wider than the profile.
std::optional<Profile> measure(const Across& across);

/// Blur of a cylinder's shadow (chords of a circle, convolved with a Gaussian) on a straight background, fitted by
/// least squares (Levenberg and Marquardt) from `start`; empty if it misses by more than 8 % of the depth.
std::optional<double> fitted_blur(const Across& across, const Profile& start);

}  // namespace ostium::data
