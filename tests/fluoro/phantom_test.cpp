/// Shapes of the phantom against closed forms.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/units.h"
#include "fluoro/matter/tissue.h"
#include "fluoro/phantom/coronaries.h"

namespace ostium::fluoro::phantom {
namespace {

using Eigen::Vector3d;

double volume_m3(const Surface& surface) {
  double six = 0;
  for (const auto& t : surface.triangles->colwise()) {
    const Vector3d a = surface.p_P.col(t[0]).cast<double>(), b = surface.p_P.col(t[1]).cast<double>(),
                   c = surface.p_P.col(t[2]).cast<double>();
    six += a.dot(b.cross(c));
  }
  return six / 6;
}

Course straight(const Vector3d& from, const Vector3d& to, double radius_m, int parent) {
  Course course{"straight", true, smooth_line({from, to}, course_step_m), {}, parent};
  course.radius_m = Eigen::VectorXd::Constant(course.line.cols(), radius_m);
  return course;
}

TEST(Phantom, ANetOfABallIsClosedAndHoldsItsVolume) {
  const Surface ball =
      net([](const Vector3d& p) { return p.norm() - 0.02; }, {-0.0251, -0.0252, -0.0253}, {0.026, 0.026, 0.026}, 1e-3);
  EXPECT_NO_THROW(check(body("ball", ball, tissue::soft, tissue::air)));
  EXPECT_NEAR(volume_m3(ball) / (4.0 / 3 * units::pi * 8e-6), 1, 2e-3);
}

TEST(Phantom, ABranchAddsWhatLiesBeyondItsParentsWall) {
  constexpr double parent_m = 2e-3, branch_m = 1e-3, length_m = 0.015;
  const std::vector<Course> courses{straight({-0.02, 0, 0}, {0.02, 0, 0}, parent_m, -1),
                                    straight({0, 0, 0}, {0, length_m, 0}, branch_m, 0)};
  const Surface branch = lumen(courses, 1).surface;
  EXPECT_NO_THROW(check(body("branch", branch, tissue::soft, tissue::soft)));
  // A cylinder with a hemisphere at its end, minus the part inside the parent: the mean of sqrt(R^2 - z^2) over the
  // disc.
  double within = 0;
  constexpr int steps = 2000;
  for (int i = 0; i < steps; ++i) {
    const double z = branch_m * (2 * (i + 0.5) / steps - 1);
    within +=
        2 * std::sqrt(branch_m * branch_m - z * z) * std::sqrt(parent_m * parent_m - z * z) * 2 * branch_m / steps;
  }
  const double whole =
      units::pi * branch_m * branch_m * length_m + 2.0 / 3 * units::pi * branch_m * branch_m * branch_m;
  EXPECT_NEAR(volume_m3(branch) / (whole - within), 1, 0.01);
}

TEST(Phantom, CoronariesFollowTheirParentsAndThinOut) {
  const std::vector<Course> courses = coronaries(0);
  EXPECT_GT(courses.size(), 100u);
  for (std::size_t i = 0; i < courses.size(); ++i) {
    const Course& course = courses[i];
    if (course.parent < 0) continue;
    ASSERT_LT(course.parent, static_cast<int>(i));
    const Course& parent = courses[static_cast<std::size_t>(course.parent)];
    EXPECT_EQ(course.left, parent.left);
    EXPECT_LT(from_course(parent, course.line.col(0)), 0) << course.name << ": begins outside its parent";
    EXPECT_LT(course.radius_m[course.radius_m.size() - 1], 0.5e-3) << course.name;
  }
}

}  // namespace
}  // namespace ostium::fluoro::phantom
