#include "fluoro/phantom/branching.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace ostium::fluoro::phantom {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using units::pi;

namespace {

double smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// A sum of waves with incommensurable lengths.
class Sway {
 public:
  explicit Sway(Random& random) {
    for (int i = 0; i < waves; ++i) {
      length_m_[i] = lengths_m[i] * random.uniform(0.85, 1.15);
      phase_[i] = random.uniform(0, 2 * pi);
    }
  }
  double operator()(double s) const {
    double sum = 0;
    for (int i = 0; i < waves; ++i) sum += shares[i] * std::sin(2 * pi * s / length_m_[i] + phase_[i]);
    return sum;
  }

 private:
  static constexpr int waves = 4;
  static constexpr double lengths_m[waves] = {0.035, 0.021, 0.012, 0.0065}, shares[waves] = {1.0, 0.6, 0.28, 0.07};
  double length_m_[waves], phase_[waves];
};

Vector3d beside(const Vector3d& along, const Vector3d& normal) {
  const Vector3d side = along.cross(normal);
  return side.norm() > 0.1 ? Vector3d(side.normalized()) : along.unitOrthogonal();
}

}  // namespace

void wind(Matrix3Xd& line, const Normal& normal, double amplitude_m, Random& random) {
  const Sway sideways(random), outwards(random);
  const Matrix3Xd straight = line;
  for (Index i = 1; i < line.cols(); ++i) {
    const Index next = std::min(i + 1, line.cols() - 1);
    const Vector3d along = (straight.col(next) - straight.col(i - 1)).normalized();
    const Vector3d side = beside(along, normal(straight.col(i))), out = side.cross(along);
    const double s = double(i) * course_step_m, faded = amplitude_m * smooth(s / 0.012);
    line.col(i) += faded * ((sideways(s) - sideways(0)) * side + 0.4 * (outwards(s) - outwards(0)) * out);
  }
}

Matrix3Xd grow(const Growth& growth, const Normal& normal, const Bed& bed, Random& random) {
  const auto points = static_cast<Index>(std::max(4.0, std::round(growth.length_m / course_step_m)));
  constexpr double correlation_m = 0.0022, return_m = 0.006;
  const double kept = std::exp(-course_step_m / correlation_m), fresh = std::sqrt(3 * (1 - kept * kept));
  Matrix3Xd line(3, points);
  Vector3d p = growth.start, along = growth.direction.normalized();
  double curl[2] = {0, 0};
  for (Index i = 0; i < points; ++i) {
    line.col(i) = p;
    const Vector3d n = normal(p), side = beside(along, n), up = side.cross(along);
    for (double& c : curl) c = kept * c + fresh * growth.curl_1_m * random.uniform(-1, 1);
    const double lifted = n.norm() > 0.1 ? 0.25 : 1;
    along += course_step_m * (curl[0] * side + lifted * curl[1] * up + (growth.goal.normalized() - along) / return_m);
    along.normalize();
    const Vector3d next = bed(p + course_step_m * along);
    along = (next - p).normalized();
    p += course_step_m * along;
  }
  return line;
}

Eigen::VectorXd calibre(Index points, const std::vector<std::pair<double, double>>& share_mm, double flare,
                        Random& random) {
  const Sway uneven(random);
  Eigen::VectorXd out(points);
  for (Index i = 0; i < points; ++i) {
    const double share = double(i) / double(points - 1), s = double(i) * course_step_m;
    std::size_t k = 1;
    while (k + 1 < share_mm.size() && share > share_mm[k].first) ++k;
    const auto& [from, from_mm] = share_mm[k - 1];
    const auto& [to, to_mm] = share_mm[k];
    out[i] = 0.5e-3 * (from_mm + (to_mm - from_mm) * std::clamp((share - from) / (to - from), 0.0, 1.0)) *
             (1 + 0.022 * uneven(0.8 * s));
  }
  // Rounds the knots over some millimetres.
  for (int pass = 0; pass < 24; ++pass) {
    const Eigen::VectorXd before = out;
    for (Index i = 1; i + 1 < points; ++i) out[i] = 0.25 * (before[i - 1] + 2 * before[i] + before[i + 1]);
  }
  const double mouth_m = 3 * out[0];
  for (Index i = 0; i < points; ++i) out[i] *= 1 + flare * std::exp(-double(i) * course_step_m / mouth_m);
  return out;
}

double from_course(const Course& course, const Vector3d& p) {
  double least = 1;
  for (Index i = 0; i + 1 < course.line.cols(); ++i) {
    const Vector3d a = course.line.col(i);
    // Points are half a millimetre apart, so segments of far points need no test.
    if ((p - a).squaredNorm() > std::pow(course.radius_m[i] + least + 2e-3, 2)) continue;
    least = std::min(least, from_rod(p, a, course.line.col(i + 1), course.radius_m[i], course.radius_m[i + 1]));
  }
  return least;
}

Lumen lumen(const std::vector<Course>& courses, std::size_t which) {
  const Course& course = courses[which];
  const double widest = course.radius_m.head(course.radius_m.size() / 2).mean();
  const int sides = widest > 1e-3 ? 14 : widest > 0.55e-3 ? 10 : widest > 0.25e-3 ? 7 : 5;
  const Index stride = widest > 0.9e-3 ? 1 : widest > 0.3e-3 ? 2 : 3;
  std::vector<int> kept;
  for (Index i = 0; i + stride / 2 + 1 < course.line.cols(); i += stride) kept.push_back(static_cast<int>(i));
  kept.push_back(static_cast<int>(course.line.cols() - 1));
  Matrix3Xd line(3, static_cast<Index>(kept.size()));
  Eigen::VectorXd radius_m(line.cols());
  for (Index i = 0; i < line.cols(); ++i) {
    line.col(i) = course.line.col(kept[static_cast<std::size_t>(i)]);
    // A polygon with the area of the circle.
    radius_m[i] =
        course.radius_m[kept[static_cast<std::size_t>(i)]] * std::sqrt(2 * pi / sides / std::sin(2 * pi / sides));
  }
  Lumen out{tube(line, radius_m, sides), tube_points(line.cols(), sides)};
  for (int& point : out.point) point = kept[static_cast<std::size_t>(point)];
  if (course.parent >= 0) {
    std::vector<const Course*> near{&courses[static_cast<std::size_t>(course.parent)]};
    for (std::size_t i = 0; i < which; ++i)
      if (courses[i].parent == course.parent && (courses[i].line.col(0) - course.line.col(0)).norm() < 4e-3)
        near.push_back(&courses[i]);
    const auto within = [&](const Vector3d& p) {
      double least = 1;
      for (const Course* other : near) least = std::min(least, from_course(*other, p));
      return least;
    };
    begin_outside(out.surface, sides, static_cast<Index>(0.010 / course_step_m) / stride + 3, within);
  }
  return out;
}

}  // namespace ostium::fluoro::phantom
