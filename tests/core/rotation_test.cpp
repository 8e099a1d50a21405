#include "core/math/rotation.h"

#include <gtest/gtest.h>

#include <random>

namespace ostium::core {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond random_rotation(std::mt19937& generator, double angle) {
  std::normal_distribution<> normal;
  return Quaterniond(
      Eigen::AngleAxisd(angle, Vector3d(normal(generator), normal(generator), normal(generator)).normalized()));
}

TEST(Rotation, VectorIsAngleTimesAxisAtAnyAngle) {
  std::mt19937 generator(1);
  for (double angle : {0.0, 1e-9, 1e-3, 0.3, 0.59, 0.61, 1.0, 3.0, 3.14}) {
    const Quaterniond q = random_rotation(generator, angle);
    const Eigen::AngleAxisd exact(q);
    const Vector3d v = to_eigen(rotation_vector(from_eigen(q)));
    EXPECT_LT((v - exact.angle() * exact.axis()).norm(), 2e-15 + 1e-15 * angle) << angle;
    // q and -q are the same rotation.
    const Vector3d w = to_eigen(rotation_vector(Q4<double>{-q.w(), -q.x(), -q.y(), -q.z()}));
    EXPECT_EQ(v, w);
  }
}

TEST(Rotation, MatrixAndDirectorAreThoseOfTheQuaternion) {
  std::mt19937 generator(2);
  const Quaterniond q = random_rotation(generator, 2.0);
  const M3<double> m = matrix(from_eigen(q));
  const Vector3d v(0.3, -0.4, 0.5);
  EXPECT_LT((to_eigen(m * from_eigen(v)) - q * v).norm(), 1e-15);
  EXPECT_LT((to_eigen(director3(from_eigen(q))) - q * Vector3d::UnitZ()).norm(), 1e-15);
}

TEST(Rotation, TurnedComposesInTheWorldFrame) {
  std::mt19937 generator(3);
  const Quaterniond q = random_rotation(generator, 1.0);
  const Vector3d phi(1e-4, -2e-4, 3e-4);
  const Quaterniond exact = Quaterniond(Eigen::AngleAxisd(phi.norm(), phi.normalized())) * q;
  EXPECT_LT(exact.angularDistance(to_eigen(turned(from_eigen(phi), from_eigen(q)))), 1e-11);  // |phi|^3 / 12
  EXPECT_NEAR(to_eigen(turned(V3<double>{50, 0, 0}, from_eigen(q))).norm(), 1, 1e-15);
}

/// Results computed four at a time are bit-identical to those computed one at a time.
TEST(Lanes, AgreeWithScalarsToTheLastBit) {
  std::mt19937 generator(4);
  Q4<Lanes> q;
  Quaterniond single[lane_count];
  const double angles[] = {0.2, 0.599, 1.5, 0.01};
  for (int l = 0; l < lane_count; ++l) {
    single[l] = random_rotation(generator, angles[l]);
    q.w[l] = single[l].w(), q.x[l] = single[l].x(), q.y[l] = single[l].y(), q.z[l] = single[l].z();
  }
  const V3<Lanes> v = rotation_vector(q);
  const S3<Lanes> s = inverse(
      symmetric_times_transpose(matrix(q) * S3<Lanes>{q.w + 2.0, q.x, q.y, q.w + 3.0, q.z, q.w + 4.0}, matrix(q)));
  for (int l = 0; l < lane_count; ++l) {
    const Q4<double> p = from_eigen(single[l]);
    const V3<double> w = rotation_vector(p);
    EXPECT_EQ(Vector3d(v.x[l], v.y[l], v.z[l]), to_eigen(w)) << l;
    const S3<double> t = inverse(
        symmetric_times_transpose(matrix(p) * S3<double>{p.w + 2.0, p.x, p.y, p.w + 3.0, p.z, p.w + 4.0}, matrix(p)));
    EXPECT_EQ(s.xx[l], t.xx);
    EXPECT_EQ(s.yz[l], t.yz);
  }
}

}  // namespace
}  // namespace ostium::core
