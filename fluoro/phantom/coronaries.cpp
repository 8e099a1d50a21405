#include "fluoro/phantom/coronaries.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace ostium::phantom {

using Eigen::Vector3d;

namespace {

/// Dodge's polar coordinates: theta about y from the front to the patient's left, phi up from the transverse plane.
Vector3d dodge(double r_cm, double theta_deg, double phi_deg) {
  constexpr double degree = std::numbers::pi / 180;
  const double t = theta_deg * degree, f = phi_deg * degree;
  return 0.01 * r_cm * Vector3d(std::cos(f) * std::sin(t), std::sin(f), std::cos(f) * std::cos(t));
}

struct Stem {
  const char* name;
  bool left;
  std::vector<Vector3d> through;  // from its ostium
  double first_mm, last_mm;       // diameters
};

const std::vector<Stem>& stems() {
  static const std::vector<Stem> all = [] {
    const Vector3d l0 = Vector3d::Zero(), lm = dodge(0.7, 80, 4), l1 = dodge(2.3, 63, -5), l2 = dodge(5.3, 44, -12),
                   l3 = dodge(10.1, 30, -32), apex = dodge(12.2, 32, -46), l4 = dodge(11.8, 33, -49);
    const Vector3d c1 = dodge(1.8, 94, -24), c2 = dodge(3.1, 116, -37), c3 = dodge(4.8, 135, -51),
                   c4 = dodge(5.9, 166, -71);
    const Vector3d s1 = dodge(3.3, 57, -9), s2 = dodge(5.2, 44, -12);
    return std::vector<Stem>{
        {"LAD",
         true,
         {l0, lm, dodge(1.6, 70, -3), l1, dodge(3.8, 52, -9), l2, dodge(7.8, 36, -21), l3, apex, l4},
         4.5,
         1.6},
        {"LCx", true, {dodge(1.0, 80, 0), dodge(1.4, 86, -13), c1, c2, c3, c4}, 3.4, 1.6},
        {"RCA",
         false,
         {l0, dodge(0.5, -71, -22), dodge(1.7, -68, -24), dodge(3.2, -71, -38), dodge(4.6, -72, -48),
          dodge(5.7, -78, -61), dodge(6.4, -91, -69), dodge(6.2, 180, -66)},
         4.0,
         2.8},
        {"D1", true, {dodge(3.2, 61, -8), dodge(4.6, 62, -17), dodge(6.2, 61, -23), dodge(8.2, 58, -31)}, 2.2, 1.0},
        {"D2", true, {dodge(4.9, 47, -12), dodge(6.3, 49, -19), dodge(7.7, 49, -24), dodge(9.2, 48, -31)}, 1.9, 0.9},
        {"D3", true, {dodge(6.6, 41, -17), dodge(7.8, 42, -22), dodge(9.0, 42, -26), dodge(10.2, 42, -33)}, 1.6, 0.8},
        {"S1", true, {s1, dodge(3.7, 45, -21), dodge(4.3, 35, -31), dodge(5.2, 30, -40)}, 1.4, 0.6},
        {"S2", true, {s2, dodge(5.4, 37, -21), dodge(5.8, 31, -29), dodge(6.5, 28, -37)}, 1.2, 0.6},
        {"S3", true, {dodge(7.0, 37, -19), dodge(7.1, 33, -25), dodge(7.3, 30, -31), dodge(7.8, 28, -37)}, 1.1, 0.6},
        {"M1", true, {dodge(2.2, 102, -31), dodge(3.8, 95, -36), dodge(5.6, 91, -38), dodge(7.4, 86, -42)}, 2.3, 1.0},
        {"M2",
         true,
         {dodge(3.4, 118, -41), dodge(4.7, 112, -48), dodge(6.0, 109, -51), dodge(7.6, 103, -55)},
         2.0,
         0.9},
        {"M3",
         true,
         {dodge(4.7, 131, -49), dodge(5.6, 124, -54), dodge(6.5, 118, -58), dodge(7.6, 110, -62)},
         1.6,
         0.8},
        {"PDA",
         false,
         {dodge(6.2, 180, -66), dodge(6.9, 130, -75), dodge(7.6, 80, -76), dodge(8.8, 60, -68)},
         2.0,
         0.9},
        {"PLV",
         false,
         {dodge(6.2, 180, -66), dodge(7.2, 155, -62), dodge(8.0, 145, -56), dodge(8.8, 132, -54)},
         1.9,
         0.9},
        {"RV1",
         false,
         {dodge(3.2, -71, -38), dodge(4.3, -45, -42), dodge(5.6, -25, -45), dodge(7.0, -10, -48)},
         1.4,
         0.7},
        {"AM", false, {dodge(5.7, -78, -61), dodge(6.2, -40, -64), dodge(7.2, -5, -62), dodge(8.4, 12, -58)}, 1.6, 0.8},
    };
  }();
  return all;
}

/// Arteries wind a little; it fades in, so that branches stay on their stems.
void wind(Eigen::Matrix3Xd& line, double phase, double amplitude_m) {
  const Eigen::Matrix3Xd straight = line;
  for (Eigen::Index i = 1; i + 1 < line.cols(); ++i) {
    const Vector3d along = (straight.col(i + 1) - straight.col(i - 1)).normalized();
    const Vector3d beside = along.cross(Vector3d(0.3, 0.5, 0.8)).normalized(), other = along.cross(beside);
    const double s = double(i) * 0.5e-3, fade = std::min(1.0, s / 0.015);
    line.col(i) +=
        fade * amplitude_m * (std::sin(s / 0.0042 + phase) * beside + 0.7 * std::sin(s / 0.0061 + 2 * phase) * other);
  }
}

constexpr double lesion_at = 0.27;  // share of the stem's length

}  // namespace

Vector3d left_ostium() { return {-0.018, 0.042, -0.022}; }
Vector3d right_ostium() { return left_ostium() + 0.7 * dodge(3.7, -25, -23); }

std::vector<Course> coronaries(double stenosis) {
  std::vector<Course> out;
  double phase = 0;
  for (const Stem& stem : stems()) {
    std::vector<Vector3d> through = stem.through;
    for (Vector3d& p : through) p += stem.left ? left_ostium() : right_ostium();
    Course course{stem.name, stem.left, smooth_line(through, 0.5e-3), {}};
    const bool trunk = out.size() < 3;
    wind(course.line, phase += 1.7, trunk ? 0.35e-3 : 0.8e-3);
    const Eigen::Index n = course.line.cols();
    const Eigen::ArrayXd along = Eigen::ArrayXd::LinSpaced(n, 0, 1);
    course.radius_m = 0.5e-3 * (stem.first_mm + (stem.last_mm - stem.first_mm) * along.pow(0.8));
    if (course.name == "LAD" || course.name == "RCA") {
      const double length_m = double(n) * 0.5e-3;
      const Eigen::ArrayXd off = (along - lesion_at) * length_m / 0.006;
      course.radius_m.array() *= 1 - stenosis * (-off.square()).exp();
    }
    out.push_back(std::move(course));
  }
  return out;
}

std::vector<Vector3d> epicardial_points() {
  std::vector<Vector3d> out;
  for (const Stem& stem : stems())
    if (stem.name[0] != 'S')
      for (const Vector3d& p : stem.through) out.push_back(p + (stem.left ? left_ostium() : right_ostium()));
  return out;
}

}  // namespace ostium::phantom
