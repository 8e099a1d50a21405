/// The numbers of a picture against pictures whose numbers are known.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

#include "data/formats/load_error.h"
#include "data/formats/png.h"
#include "data/picture/background.h"
#include "data/picture/frames_file.h"
#include "data/picture/likeness.h"
#include "data/picture/profile.h"
#include "data/picture/vessels.h"

namespace ostium::data {
namespace {

constexpr int side = 512;

Image white_noise(double mean, double deviation) {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal(mean, deviation);
  Image out(side, side);
  for (Eigen::Index i = 0; i < out.size(); ++i) out.data()[i] = normal(engine);
  return out;
}

Mask everywhere() { return Mask::Constant(side, side, true); }
Mask nowhere() { return Mask::Constant(side, side, false); }

/// A cylinder full of contrast across the picture, at that angle to the rows, blurred.
Image with_vessel(double diameter, double blur, double ln_contrast, double angle) {
  Image depth = Image::Zero(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double d = (y - 256) * std::cos(angle) - (x - 256) * std::sin(angle);
      depth(y, x) = 2 * std::sqrt(std::max(0.25 * diameter * diameter - d * d, 0.0)) / diameter;
    }
  // Faint enough that grey is nearly linear in depth.
  return 120 * (1 - (1 - std::exp(-ln_contrast)) * gaussian(depth, blur));
}

TEST(Picture, AGaussianKeepsSumAndHasItsVariance) {
  Image one = Image::Zero(65, 65);
  one(32, 32) = 1;
  const Image blurred = gaussian(one, 2.5);
  double variance = 0;
  for (int y = 0; y < 65; ++y)
    for (int x = 0; x < 65; ++x) variance += blurred(y, x) * (y - 32) * (y - 32);
  EXPECT_NEAR(blurred.sum(), 1, 1e-12);
  EXPECT_NEAR(variance, 6.25, 0.01);  // cut off at four deviations: a thousandth
}

TEST(Picture, DerivativesOfAParabolaAreExact) {
  Image parabola(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) parabola(y, x) = 0.5 * (x - 30) * (x - 30) + 3 * y;
  EXPECT_NEAR(gaussian(parabola, 2, 0, 2)(32, 32), 1, 0.02);  // sampling at two pixels
  EXPECT_NEAR(std::fabs(gaussian(parabola, 2, 1, 0)(32, 32)), 3, 0.02);
}

TEST(Picture, ABarThinsToALineAndASpurGoes) {
  Mask bar = nowhere();
  bar.block(200, 100, 7, 200).setConstant(true);
  bar.block(190, 180, 10, 3).setConstant(true);  // a bump shorter than a spur
  const Mask line = pruned(thinned(bar), 10);
  EXPECT_NEAR(static_cast<double>(line.count()), 200, 10);
  std::vector<Eigen::Vector2i> pixels;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      if (line(y, x)) pixels.push_back({y, x});
  std::shuffle(pixels.begin(), pixels.end(), std::mt19937(3));
  const std::vector<Eigen::Vector2i> ordered = in_order(pixels);
  // The shortest way leaves out corners.
  EXPECT_GE(ordered.size(), 193u);  // the bar, less half its height at either end
  EXPECT_LE(ordered.size(), pixels.size());
  for (std::size_t i = 1; i < ordered.size(); ++i) EXPECT_LE((ordered[i] - ordered[i - 1]).cwiseAbs().maxCoeff(), 1);
}

TEST(Picture, ACylindersWidthContrastAndBlurAreRead) {
  for (double degrees : {0.0, 20.0})
    for (double diameter : {9.0, 12.0})
      for (double blur : {0.8, 1.6}) {
        const double angle = degrees * std::numbers::pi / 180;
        const Across a =
            across(with_vessel(diameter, blur, 0.25, angle), {256.3, 256}, {std::sin(angle), std::cos(angle)}, 20);
        const std::optional<Profile> profile = measure(a);
        ASSERT_TRUE(profile.has_value());
        // Half a circle's chord; steps of half a pixel and seven pixels' mean along it leave 8 %.
        EXPECT_NEAR(profile->width_px, diameter * std::sqrt(3) / 2, 0.08 * diameter);
        EXPECT_NEAR(std::log(profile->background / (profile->background - profile->depth)), 0.25, 0.03);
        const std::optional<double> fitted = fitted_blur(a, *profile);
        ASSERT_TRUE(fitted.has_value());
        // Linear interpolation between pixels blurs by another 0.3 to 0.4.
        EXPECT_NEAR(*fitted, std::hypot(blur, 0.35), 0.25);
      }
}

TEST(Picture, AStraightVesselIsOneBranchOfItsLength) {
  Mask inner = nowhere();
  inner.block(51, 51, side - 102, side - 102).setConstant(true);
  const VesselTree tree = find_vessels(with_vessel(10, 1, 0.25, 0), inner);
  EXPECT_NEAR(tree.length_px, 1.12 * (side - 102), 0.05 * side);  // 1.12 a pixel of the skeleton
  EXPECT_EQ(tree.junctions, 0);
  EXPECT_GT(tree.profiles.size(), 50u);
  EXPECT_NEAR(tree.bend_rad_px, 0, 1e-3);
}

TEST(Picture, NoiseHasTheSlopeAndTheGrainOfItsBlur) {
  for (double blur : {0.75, 0.9}) {
    const Image image = gaussian(white_noise(110, 12), blur);
    // White noise through g_s less g_s * g_3: the covariance of such Gaussians is a sum of Gaussians.
    const double s2 = blur * blur;
    const auto covariance = [&](double d) {
      const auto one = [&](double v) { return std::exp(-0.5 * d * d / v) / v; };
      return one(2 * s2) - 2 * one(2 * s2 + 9) + one(2 * s2 + 18);
    };
    const double grain = covariance(1) / covariance(0);
    const Grain measured = measure_grain(image, everywhere());
    ASSERT_TRUE(measured.enough);
    EXPECT_NEAR(measured.grain, grain, 0.05);
    EXPECT_NEAR(measured.noise_dark_over_light, 1, 0.08);
    // d ln P / d ln f = -8 pi^2 s^2 f^2, its mean over the octave fitted.
    const Background b = measure_background(image, nowhere(), everywhere());
    double slope = 0;
    int n = 0;
    for (double f = 0.2; f < 0.45; f *= 1.1, ++n) slope -= 8 * std::numbers::pi * std::numbers::pi * s2 * f * f;
    EXPECT_NEAR(b.psd_slope_noise, slope / n, 0.25 * std::fabs(slope / n));
  }
}

TEST(Picture, SidesWithACollimatorsEdgeAreCounted) {
  Image image = Image::Constant(side, side, 120);
  EXPECT_EQ(border_sides(image), 0);
  image.leftCols(12).setConstant(10);
  image.bottomRows(12).setConstant(10);
  EXPECT_EQ(border_sides(image), 2);
}

TEST(Picture, EveryNumberHasARangeAndAVerdict) {
  const Likeness numbers = measure_likeness(with_vessel(10, 1, 0.25, 0));
  const LikenessVerdict frame = judge_frame(numbers), set = judge_set(numbers);
  EXPECT_EQ(frame.ranges, 9);
  EXPECT_EQ(set.ranges, 18);
  EXPECT_EQ(frame.held + static_cast<int>(frame.misses.size()), 9);
  Likeness half = numbers;
  half["p50"] = 0;
  EXPECT_DOUBLE_EQ(median_of({numbers, half})["p50"], 0.5 * numbers.at("p50"));
}

TEST(Picture, OddFilesAreReadAndSaidToBeOdd) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "picture_files";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const std::string grey = folder / "grey.png", colour = folder / "colour.png", text = folder / "text.txt";
  EXPECT_THROW(frame_files(folder), LoadError);  // no frames
  fluoro::Picture picture{200, 100, std::vector<std::uint8_t>(20000, 77)};
  write_png(grey, picture);
  write_rgb_png(colour, 512, 512, [] {
    std::vector<std::uint8_t> rgb;
    for (int i = 0; i < 512 * 512; ++i) rgb.insert(rgb.end(), {30, 60, 90});
    return rgb;
  }());
  const FramesFile other_size = read_frames(grey);
  EXPECT_EQ(other_size.frames.front()(50, 100), 77);
  EXPECT_EQ(other_size.remarks.size(), 2u);  // not square, not 512
  const FramesFile mean = read_frames(colour);
  EXPECT_DOUBLE_EQ(mean.frames.front()(5, 5), 60);
  ASSERT_EQ(mean.remarks.size(), 1u);
  EXPECT_NE(mean.remarks.front().find("colour"), std::string::npos);
  EXPECT_EQ(frame_files(folder).size(), 2u);
  EXPECT_THROW(read_frames(folder / "none.png"), LoadError);
  write_png(grey, {32, 32, std::vector<std::uint8_t>(1024, 77)});
  EXPECT_THROW(read_frames(grey), LoadError);  // too small
}

TEST(Picture, TextIsNoticed) {
  Image image = gaussian(white_noise(110, 10), 0.7);
  EXPECT_FALSE(seems_to_have_text(image));
  for (int letter = 0; letter < 30; ++letter) image.block(20, 20 + 9 * letter, 10, 1).setConstant(255);
  EXPECT_TRUE(seems_to_have_text(image));
}

}  // namespace
}  // namespace ostium::data
