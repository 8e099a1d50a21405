/// What covers a pixel in closed forms: triangles, tubes and a sphere before a point source.
#include "fluoro/projection/silhouette.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "fluoro/matter/tissue.h"
#include "fluoro/phantom/shapes.h"

namespace ostium::fluoro {
namespace {

using Eigen::Vector3d;

View oblique() {
  View view;
  view.arm.lao_rad = 0.7, view.arm.cran_rad = -0.4, view.arm.p_PI = {0.01, -0.02, 0.03};
  view.field_m = 0.16, view.pixels = 200;
  return view;
}

/// The isocentre is the picture's middle; what is a metre per pixel there to the right and up is the same in the
/// picture.
TEST(Silhouette, PointsAreWhereTheDetectorHasThem) {
  const View view = oblique();
  const ImageAxes axes(view.arm);
  const auto middle = picture_point(view, view.arm.p_PI);
  ASSERT_TRUE(middle);
  EXPECT_NEAR((middle->at - Eigen::Vector2d(100, 100)).norm(), 0, 1e-9);
  EXPECT_NEAR(middle->depth_m, view.arm.source_to_isocentre_m, 1e-12);
  const double pixels_per_m =
      view.pixels / view.field_m * view.arm.source_to_detector_m / view.arm.source_to_isocentre_m;
  const auto beside = picture_point(view, view.arm.p_PI + 0.01 * axes.right + 0.02 * axes.up);
  EXPECT_NEAR((beside->at - Eigen::Vector2d(100 + 0.01 * pixels_per_m, 100 - 0.02 * pixels_per_m)).norm(), 0, 1e-9);
  EXPECT_FALSE(picture_point(view, source(view.arm) - 0.01 * axes.outwards));
  const Eigen::Matrix<double, 3, 4> P = projection_matrix(view);
  for (const Vector3d& p : {Vector3d(0.03, 0.02, -0.05), Vector3d(-0.04, 0.01, 0.02)}) {
    const Vector3d h = P * p.homogeneous();
    const auto at = picture_point(view, p);
    EXPECT_NEAR((h.hnormalized() - at->at).norm(), 0, 1e-9);
    EXPECT_NEAR(h.z(), at->depth_m, 1e-12);
  }
}

/// A sphere at the isocentre of radius r, seen from d, has the half-angle asin(r / d); its nearest point is at d - r.
TEST(Silhouette, OfASphereIsADisc) {
  View view = oblique();
  const double r = 0.02, d = view.arm.source_to_isocentre_m;
  const Body ball =
      phantom::body("ball", phantom::ellipsoid(view.arm.p_PI, Vector3d::Constant(r), 40), tissue::soft, tissue::air);
  Silhouette covered(view);
  covered.add(ball);
  const double radius_px = std::tan(std::asin(r / d)) * view.arm.source_to_detector_m / view.field_m * view.pixels;
  // Flat triangles lie within; a pixel of the rim is in or out.
  EXPECT_NEAR(static_cast<double>(covered.pixels()) / (units::pi * radius_px * radius_px), 1, 0.02);
  EXPECT_NEAR(covered.depth_m()(100, 100), d - r, 0.02 * r);
  EXPECT_FALSE(covered.covers(100, 100 + static_cast<int>(radius_px) + 2));
}

/// Two triangles of a square share its diagonal: no pixel is left out or counted twice, and the depth is that of the
/// plane.
TEST(Silhouette, OfASquareHasItsPixelsAndDepths) {
  View view;
  view.pixels = 200, view.field_m = 0.2;
  const ImageAxes axes(view.arm);
  const double magnification = view.arm.source_to_detector_m / view.arm.source_to_isocentre_m;
  const auto corner = [&](double right_px, double up_px) {
    return Vector3d(1e-3 / magnification * (right_px * axes.right + up_px * axes.up));
  };
  Silhouette covered(view);
  const Vector3d a = corner(-10, -20), b = corner(30, -20), c = corner(30, 25), e = corner(-10, 25);
  covered.add(a, b, c);
  covered.add(a, c, e);
  EXPECT_EQ(covered.pixels(), 40 * 45);
  EXPECT_TRUE(covered.covers(75, 90));
  EXPECT_FALSE(covered.covers(74, 90));
  EXPECT_NEAR(covered.depth_m()(100, 100), view.arm.source_to_isocentre_m, 1e-6);
  covered.add(corner(500, 500), corner(600, 500), corner(500, 600));  // outside
  EXPECT_EQ(covered.pixels(), 40 * 45);
}

/// A tube of radius r pixels and length l has 2 r l + pi r^2 of them; a thin one has those that its axis crosses.
TEST(Silhouette, OfATubeIsItsOutline) {
  View view;
  view.pixels = 400, view.field_m = 0.2;
  const ImageAxes axes(view.arm);
  const double px_m = view.field_m / view.pixels * view.arm.source_to_isocentre_m / view.arm.source_to_detector_m;
  Eigen::Matrix3Xd line(3, 3);
  line << -50 * px_m * axes.right, Vector3d::Zero(), 50 * px_m * axes.right;
  Silhouette thick(view);
  thick.add_tube(line, std::vector<double>(3, 12.25 * px_m));
  EXPECT_NEAR(static_cast<double>(thick.pixels()), 2 * 12.25 * 100 + units::pi * 12.25 * 12.25, 110)
      << "half a pixel along the outline of 200 pixels";
  Eigen::Matrix3Xd moved = line.colwise() + 0.25 * px_m * axes.up;
  Silhouette thin(view);
  thin.add_tube(moved, std::vector<double>(3, 1e-6));
  EXPECT_NEAR(static_cast<double>(thin.pixels()), 100, 1);
  EXPECT_TRUE(thin.covers(199, 180));
  EXPECT_FALSE(thin.covers(200, 180));
}

}  // namespace
}  // namespace ostium::fluoro
