#pragma once
/// Grey levels as numbers, and the filters that measuring them takes.
#include <Eigen/Core>
#include <vector>

namespace ostium::data {

/// 0 to 255, row 0 at the top.
using Image = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Mask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

inline constexpr int measured_side = 512;  ///< every number is of a picture of so many pixels a side

/// The middle square brought to `measured_side`, by area where it divides.
Image to_measured_side(const Image& image);

/// Convolution with a Gaussian, or its first or second derivative, along rows (x) and columns (y), cut off at four
/// standard deviations, mirrored at the edges.
Image gaussian(const Image& image, double sigma_pixels, int order_y = 0, int order_x = 0);
/// Of a row of numbers; beyond its ends the same value, or mirrored.
std::vector<double> gaussian(const std::vector<double>& values, double sigma, bool mirrored);
/// Length of the gradient of the picture smoothed so.
Image gradient(const Image& image, double sigma_pixels);

/// Linear between pixels, constant beyond the edges.
double sample(const Image& image, double y, double x);

double mean(const std::vector<double>& values);
double deviation(const std::vector<double>& values);  ///< with n, not n - 1
/// Robust standard deviation: 1.4826 of the median distance from the median.
double robust_deviation(const std::vector<double>& values);
/// Of the pixels in the mask, row after row.
std::vector<double> values_in(const Image& image, const Mask& mask);

}  // namespace ostium::data
