#include "fluoro/projection/shaft_layer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fluoro/phantom/shapes.h"

namespace ostium::fluoro {
namespace {

using Eigen::Vector3d;

struct Drawn {
  View view;
  Beam beam = make_beam({80, 3, 0.2}, {});
  ShaftLayer layer;

  explicit Drawn(int pixels = 512) : view{.arm = {}, .field_m = 0.2, .pixels = pixels} {}
  /// Thickness along the ray, m.
  Plane thickness(const Shaft& shaft) {
    layer.draw(view, beam, {&shaft, 1});
    return layer.optical_depth[2] / beam.mu(Material::steel)[2];
  }
  double pixel_m() const {  // at the isocentre
    return view.field_m / view.pixels * view.arm.source_to_isocentre_m / view.arm.source_to_detector_m;
  }
};

Shaft steel(const Eigen::Matrix3Xd& line, double outer_m, double inner_m = 0) {
  return {"shaft", line, {{0, 10, Material::steel, outer_m, inner_m, 1}}, 0, {}};
}

TEST(ShaftLayer, WhatMovesDuringAPulseIsSpreadOverItsWay) {
  // Across: the same metal, and the variance of its profile grows by that of a way of 2 mm. Along: nothing but the
  // ends.
  const Eigen::Matrix3Xd line = phantom::smooth_line({{-0.03, 0, 0}, {0.03, 0, 0}}, 0.002);
  Drawn drawn;
  struct Profile {
    double sum = 0, variance_m2 = 0;
  };
  const auto profile = [&](const Vector3d& v_P) {
    Shaft wire = steel(line, 0.2e-3);
    wire.v_P = v_P.replicate(1, line.cols());
    drawn.layer.draw(drawn.view, drawn.beam, {&wire, 1}, 0.01);
    const Plane& depth = drawn.layer.optical_depth[2];
    Profile out;
    double first = 0, second = 0;
    for (Eigen::Index row = 0; row < depth.rows(); ++row) {
      const double weight = double(depth(row, 256)), at = (double(row) + 0.5) * drawn.pixel_m();
      out.sum += weight, first += weight * at, second += weight * at * at;
    }
    out.variance_m2 = second / out.sum - std::pow(first / out.sum, 2);
    return out;
  };
  const Profile still = profile({0, 0, 0}), across = profile({0, 0.2, 0}), along = profile({0.2, 0, 0});
  EXPECT_NEAR(across.sum / still.sum, 1, 0.01);
  EXPECT_NEAR((across.variance_m2 - still.variance_m2) / (2e-3 * 2e-3 / 12), 1, 0.02);
  EXPECT_NEAR(along.sum / still.sum, 1, 1e-5);
  EXPECT_NEAR(along.variance_m2 / still.variance_m2, 1, 1e-5);
}

TEST(ShaftLayer, NoMetalIsLostHoweverThinTheWire) {
  // Closed form: the sum over all pixels is the wire's volume, straight or bent, a tenth of a pixel or ten.
  const Eigen::Matrix3Xd straight = phantom::smooth_line({{-0.03, -0.011, 0}, {0.03, 0.017, 0}}, 0.002);
  Eigen::Matrix3Xd arc(3, 60);
  for (int i = 0; i < 60; ++i) arc.col(i) = 0.02 * Vector3d(std::cos(0.04 * i), std::sin(0.04 * i), 0);
  for (const Eigen::Matrix3Xd& line : {straight, arc}) {
    double length = 0;
    for (Eigen::Index i = 1; i < line.cols(); ++i) length += (line.col(i) - line.col(i - 1)).norm();
    for (double radius : {0.03e-3, 0.178e-3, 1e-3}) {
      Drawn drawn;
      const double volume =
          drawn.thickness(steel(line, radius)).cast<double>().sum() * drawn.pixel_m() * drawn.pixel_m();
      EXPECT_NEAR(volume / (3.14159265 * radius * radius * length), 1, 0.01) << radius;
    }
  }
}

TEST(ShaftLayer, AWireAskewToTheRayIsThickerByTheSine) {
  const double radius = 1e-3, angle = 0.6;  // from the ray
  const Vector3d along(std::sin(angle), 0, std::cos(angle));
  Eigen::Matrix3Xd line(3, 2);
  line << -0.02 * along, 0.02 * along;
  Drawn drawn(1024);
  const Plane thickness = drawn.thickness(steel(line, radius));
  EXPECT_NEAR(double(thickness.col(512).maxCoeff()), 2 * radius / std::sin(angle), 0.03 * radius);
}

TEST(ShaftLayer, ACatheterIsDarkerAtItsWalls) {
  Eigen::Matrix3Xd line(3, 2);
  line << -0.05, 0.05, 0, 0, 0, 0;
  Drawn drawn(1024);
  drawn.view.field_m = 0.05;
  const Plane thickness = drawn.thickness(steel(line, 1e-3, 0.9e-3));
  const double middle = double(thickness(512, 512)), most = double(thickness.col(512).maxCoeff());
  EXPECT_NEAR(middle, 0.2e-3, 2e-6);                                 // two walls
  EXPECT_NEAR(most, 2 * std::sqrt(1e-6 - 0.81e-6), 0.15 * 0.87e-3);  // beside the bore, less a pixel's width
}

TEST(ShaftLayer, PiecesShareThePixelsOfAJoint) {
  // The same straight wire in 3 pieces or 300.
  const std::vector<Vector3d> ends{{-0.03, -0.01, 0}, {0.03, 0.01, 0}};
  Drawn drawn;
  const Plane coarse = drawn.thickness(steel(phantom::smooth_line(ends, 0.02), 0.3e-3));
  const Plane fine = drawn.thickness(steel(phantom::smooth_line(ends, 0.0002), 0.3e-3));
  EXPECT_LT((coarse - fine).abs().maxCoeff(), 0.01 * 0.6e-3);
}

TEST(ShaftLayer, AMarkerIsAsLongAsItIs) {
  Shaft shaft = steel(phantom::smooth_line({{-0.02, 0, 0}, {0.02, 0, 0}}, 0.001), 0.4e-3);
  shaft.sections[0].from_tip_m = 0.0103;
  shaft.sections[0].to_tip_m = 0.0113;
  Drawn drawn(1024);
  const Plane thickness = drawn.thickness(shaft);
  const double volume = thickness.cast<double>().sum() * drawn.pixel_m() * drawn.pixel_m();
  EXPECT_NEAR(volume / (3.14159265 * 0.16e-6 * 0.001), 1, 0.02);
  // Drawing again without it leaves nothing behind.
  EXPECT_EQ(drawn.thickness(steel(Eigen::Matrix3Xd::Constant(3, 2, 5.0), 1e-3)).abs().maxCoeff(), 0);
}

}  // namespace
}  // namespace ostium::fluoro
