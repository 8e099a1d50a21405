/// The camera of a view: closed forms, another camera of the tests' own, and the angles of DICOM.
#include "data/identification/measurement/camera.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "fluoro/projection/c_arm.h"
#include "tests/support/dice.h"
#include "tests/support/pinhole.h"

namespace ostium::data {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using units::mm, units::degree;

/// Source 800 mm behind the origin, detector 200 mm in front of it, rows towards +z.
Camera level() {
  Camera c;
  c.columns = 101, c.rows = 51, c.pixel_m = 1 * mm;
  c.u = Vector3d::UnitX(), c.v = Vector3d::UnitZ();
  c.source_m = Vector3d(0, 800, 0) * mm;
  c.pixel_0_0_m = Vector3d(-50, -200, -25) * mm;
  return c;
}

TEST(Camera, MagnifiesByTheDistances) {
  const Camera c = level();
  EXPECT_NEAR(c.source_to_detector_m(), 1, 1e-12);
  EXPECT_LT((c({0, 0, 0}) - Vector2d(50, 25)).norm(), 1e-12);
  EXPECT_LT((c(Vector3d(8, 0, 4) * mm) - Vector2d(60, 30)).norm(), 1e-9) << "1000 / 800";
  EXPECT_LT((c(Vector3d(8, 300, 4) * mm) - Vector2d(66, 33)).norm(), 1e-9) << "1000 / 500";
  EXPECT_LT((c(c.pixel_in_room({7, 9})) - Vector2d(7, 9)).norm(), 1e-9) << "a pixel sees itself";
  EXPECT_FALSE(c(Vector3d(0, 900, 0) * mm).allFinite()) << "behind the source";
}

TEST(Camera, WarpsAboutTheMiddle) {
  Camera c = level();
  const Vector3d edge = Vector3d(40, 0, 0) * mm;  // 50 px out, nearly half the width
  const double r2 = 50.0 * 50 / (50.5 * 50.5);
  c.pincushion = 0.1;
  EXPECT_LT((c(edge) - Vector2d(50 + 50 * (1 + 0.1 * r2), 25)).norm(), 1e-9);
  c.pincushion = 0, c.s_turn_rad = 0.2;
  EXPECT_LT((c(edge) - Vector2d(50 + 50 * std::cos(0.2 * r2), 25 + 50 * std::sin(0.2 * r2))).norm(), 1e-9);
  c.s_turn_rad = 0, c.shift_px = {3, -4};
  EXPECT_LT((c(edge) - Vector2d(103, 21)).norm(), 1e-9);
}

synthetic::Pinhole drawn(synthetic::Dice& dice) {
  synthetic::Pinhole p;
  p.primary_deg = dice.uniform(-90, 90), p.secondary_deg = dice.uniform(-40, 40);
  p.isocentre_m = 0.05 * dice.normals();
  p.rows_down = dice.sign() > 0;
  return p;
}

Camera camera_of(const synthetic::Pinhole& p) {
  Camera c;
  c.source_m = p.source_m(), c.pixel_0_0_m = p.first_pixel_m();
  c.u = p.axes().row(0).transpose(), c.v = p.axes().row(1).transpose();
  c.pixel_m = p.pixel_m, c.columns = p.columns, c.rows = p.rows;
  return c;
}

TEST(Camera, AgreesWithAProjectionMatrix) {
  synthetic::Dice dice("camera", 1);
  for (int i = 0; i < 50; ++i) {
    synthetic::Pinhole p = drawn(dice);
    Camera c = camera_of(p);
    p.barrel = c.pincushion = dice.uniform(-0.1, 0.1);
    p.turn_at_edge = c.s_turn_rad = dice.uniform(-0.1, 0.1);
    const Vector3d at = p.isocentre_m + 0.08 * dice.normals();
    EXPECT_LT((c(at) - p.picture_of(at)).norm(), 1e-7);
  }
}

/// A turned camera is the camera that the other angles make.
TEST(Camera, TurnsToOtherAngles) {
  synthetic::Dice dice("turned camera", 1);
  for (int i = 0; i < 20; ++i) {
    const synthetic::Pinhole from = drawn(dice);
    synthetic::Pinhole to = from;
    to.primary_deg += dice.uniform(-10, 10), to.secondary_deg += dice.uniform(-10, 10);
    Camera c = camera_of(from);
    const GantryAngles at = gantry_angles(c.outwards());
    EXPECT_NEAR(at.primary_rad, from.primary_deg * degree, 1e-12);
    EXPECT_NEAR(at.secondary_rad, from.secondary_deg * degree, 1e-12);
    turn_about(c, from.isocentre_m,
               gantry_turn(at, {(to.primary_deg - from.primary_deg) * degree,
                                (to.secondary_deg - from.secondary_deg) * degree}));
    const Vector3d p = from.isocentre_m + 0.08 * dice.normals();
    EXPECT_LT((c(p) - to.picture_of(p)).norm(), 1e-7);
  }
}

TEST(Camera, IsocentreIsWhereTheRaysMeet) {
  synthetic::Dice dice("isocentre", 1);
  for (int i = 0; i < 20; ++i) {
    synthetic::Pinhole a = drawn(dice), b = drawn(dice);
    b.isocentre_m = a.isocentre_m;
    EXPECT_LT((isocentre_m({camera_of(a), camera_of(b)}) - a.isocentre_m).norm(), 1e-5);
    a.isocentre_m.setZero();
    EXPECT_LT(isocentre_m({camera_of(a)}).norm(), 1e-5) << "of a single view, what is nearest to the origin";
  }
}

/// The renderer's frame has y to the head and z to the front.
TEST(Camera, AnglesAreThoseOfTheRenderer) {
  fluoro::CArm arm;
  arm.lao_rad = -0.7, arm.cran_rad = 0.4;
  const Vector3d there = towards_detector(arm), here = outwards_at({arm.lao_rad, arm.cran_rad});
  EXPECT_LT((here - Vector3d(there.x(), -there.z(), there.y())).norm(), 1e-12);
}

}  // namespace
}  // namespace ostium::data
