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

/// A cylinder full of contrast across the picture, 20 degrees from the rows, blurred.
Image with_vessel(double diameter, double blur, double ln_contrast) {
  const double angle = 20 * std::numbers::pi / 180;
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
  EXPECT_EQ(branches_of(line).junctions.count(), 0);
  std::vector<Eigen::Vector2i> pixels;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      if (line(y, x)) pixels.push_back({y, x});
  std::shuffle(pixels.begin(), pixels.end(), std::mt19937(3));
  const std::vector<Eigen::Vector2i> ordered = in_order(pixels);
  ASSERT_EQ(ordered.size(), pixels.size());
  for (std::size_t i = 1; i < ordered.size(); ++i) EXPECT_LE((ordered[i] - ordered[i - 1]).cwiseAbs().maxCoeff(), 1);
}

TEST(Picture, ACylindersWidthContrastAndBlurAreRead) {
  for (double diameter : {9.0, 12.0}) {
    for (double blur : {0.8, 1.6}) {
      const Image image = with_vessel(diameter, blur, 0.25);
      Mask inner = nowhere();
      inner.block(51, 51, side - 102, side - 102).setConstant(true);
      const VesselTree tree = find_vessels(image, inner);
      ASSERT_GT(tree.profiles.size(), 20u);
      EXPECT_EQ(tree.junctions, 0);
      // 1.12 a pixel of the skeleton, which at 20 degrees has one a column.
      EXPECT_NEAR(tree.length_px, 1.12 * (side - 102), 0.05 * side);
      std::vector<double> width, contrast, fitted;
      for (const Profile& p : tree.profiles) {
        width.push_back(p.width_px), contrast.push_back(std::log(p.background / (p.background - p.depth)));
        if (p.blur_px) fitted.push_back(*p.blur_px);
      }
      EXPECT_NEAR(median(width), diameter * std::sqrt(3) / 2, 0.5);  // half a circle's chord; blur adds a little
      EXPECT_NEAR(median(contrast), 0.25, 0.03);
      ASSERT_GE(fitted.size(), 3u);
      // Linear interpolation between pixels blurs by another 0.3 to 0.4.
      EXPECT_NEAR(median(fitted), std::hypot(blur, 0.35), 0.2);
    }
  }
}

TEST(Picture, AWindingLineTurnsAsItShould) {
  // A sine of amplitude A and wave number k turns by 2 atan(A k) twice a period.
  constexpr double amplitude = 12, k = 2 * std::numbers::pi / 80;
  Image image = Image::Constant(side, side, 120);
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y) {
      const double slope = amplitude * k * std::cos(k * x),
                   d = (y - 256 - amplitude * std::sin(k * x)) / std::hypot(1, slope);
      image(y, x) -= 40 * std::exp(-0.5 * d * d / 4);
    }
  Mask inner = nowhere();
  inner.block(51, 51, side - 102, side - 102).setConstant(true);
  double length = 0;
  for (double x = 0; x < 80; x += 0.1) length += 0.1 * std::hypot(1, amplitude * k * std::cos(k * x));
  EXPECT_NEAR(find_vessels(image, inner).bend_rad_px, 4 * std::atan(amplitude * k) / length, 0.008);
}

TEST(Picture, NoiseHasTheSlopeAndTheGrainOfItsBlur) {
  for (double blur : {0.6, 0.9}) {
    const Image image = gaussian(white_noise(110, 12), blur);
    // Neighbours of white noise blurred by a Gaussian: exp(-1 / 4 s^2); what is slower than 3 px is taken off before.
    const double s2 = blur * blur, grain = std::exp(-0.25 / s2);
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
  const Likeness numbers = measure_likeness(with_vessel(10, 1, 0.25));
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
