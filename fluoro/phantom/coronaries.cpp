#include "fluoro/phantom/coronaries.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/units.h"
#include "fluoro/phantom/heart.h"

namespace ostium::fluoro::phantom {

using Eigen::Vector3d;

namespace {

/// Dodge's polar coordinates: theta about y from the front to the patient's left, phi up from the transverse plane.
Vector3d dodge(double r_cm, double theta_deg, double phi_deg) {
  using units::degree;
  const double t = theta_deg * degree, f = phi_deg * degree;
  return 0.01 * r_cm * Vector3d(std::cos(f) * std::sin(t), std::sin(f), std::cos(f) * std::cos(t));
}

struct Stem {
  const char* name;
  bool left;
  std::vector<Vector3d> through;                    // points it passes through, from its ostium
  std::vector<std::pair<double, double>> share_mm;  // diameters by share of its length
  const char* from = "";                            // the vessel it branches from
};

const std::vector<Stem>& stems() {
  static const std::vector<Stem> all = [] {
    const Vector3d l0 = Vector3d::Zero(), lm = dodge(0.7, 80, 4), l1 = dodge(2.3, 63, -5), l2 = dodge(5.3, 44, -12),
                   l3 = dodge(10.1, 30, -32), apex = dodge(12.2, 32, -46);
    const Vector3d c1 = dodge(1.8, 94, -24), c2 = dodge(3.1, 116, -37), c3 = dodge(4.8, 135, -51),
                   c4 = dodge(5.9, 166, -71);
    const Vector3d s1 = dodge(3.3, 57, -9), s2 = dodge(5.2, 44, -12);
    return std::vector<Stem>{
        {"LAD",
         true,
         {Vector3d(-0.0072, -0.0004, -0.0008), l0, lm, dodge(1.6, 70, -3), l1, dodge(3.8, 52, -9), l2,
          dodge(7.8, 36, -21), l3, apex},
         {{0, 5},
          {0.02, 6.4},
          {0.05, 5.0},
          {0.07, 4.4},
          {0.13, 4.2},
          {0.18, 3.6},
          {0.33, 3.2},
          {0.5, 2.5},
          {0.75, 1.7},
          {0.93, 0.95},
          {1, 0.7}}},
        {"LCx",
         true,
         {dodge(1.0, 80, 0), dodge(1.4, 86, -13), c1, c2, c3, c4},
         {{0, 3.4}, {0.25, 3.1}, {0.4, 2.5}, {0.7, 1.8}, {0.95, 1.0}, {1, 0.8}},
         "LAD"},
        {"RCA",
         false,
         {Vector3d(0.0064, 0.0027, -0.0022), l0, dodge(0.5, -71, -22), dodge(1.7, -68, -24), dodge(3.2, -71, -38),
          dodge(4.6, -72, -48), dodge(5.7, -78, -61), dodge(6.4, -91, -69), dodge(6.2, 180, -66)},
         {{0, 4.5}, {0.02, 6}, {0.05, 4.5}, {0.07, 4.0}, {0.3, 3.7}, {0.6, 3.3}, {0.9, 2.8}, {1, 2.5}}},
        {"D1",
         true,
         {dodge(3.2, 61, -8), dodge(4.6, 62, -17), dodge(6.2, 61, -23), dodge(8.2, 58, -31)},
         {{0, 2.1}, {1, 0.65}},
         "LAD"},
        {"D2",
         true,
         {dodge(4.9, 47, -12), dodge(6.3, 49, -19), dodge(7.7, 49, -24), dodge(9.2, 48, -31)},
         {{0, 1.7}, {1, 0.55}},
         "LAD"},
        {"D3",
         true,
         {dodge(6.6, 41, -17), dodge(7.8, 42, -22), dodge(9.0, 42, -26), dodge(10.2, 42, -33)},
         {{0, 1.3}, {1, 0.5}},
         "LAD"},
        {"S1", true, {s1, dodge(3.7, 45, -21), dodge(4.3, 35, -31), dodge(5.2, 30, -40)}, {{0, 1.3}, {1, 0.4}}, "LAD"},
        {"S2", true, {s2, dodge(5.4, 37, -21), dodge(5.8, 31, -29), dodge(6.5, 28, -37)}, {{0, 1.1}, {1, 0.4}}, "LAD"},
        {"S3",
         true,
         {dodge(7.0, 37, -19), dodge(7.1, 33, -25), dodge(7.3, 30, -31), dodge(7.8, 28, -37)},
         {{0, 0.9}, {1, 0.35}},
         "LAD"},
        {"M1",
         true,
         {dodge(2.2, 102, -31), dodge(3.8, 95, -36), dodge(5.6, 91, -38), dodge(7.4, 86, -42)},
         {{0, 2.2}, {1, 0.7}},
         "LCx"},
        {"M2",
         true,
         {dodge(3.4, 118, -41), dodge(4.7, 112, -48), dodge(6.0, 109, -51), dodge(7.6, 103, -55)},
         {{0, 1.9}, {1, 0.65}},
         "LCx"},
        {"M3",
         true,
         {dodge(4.7, 131, -49), dodge(5.6, 124, -54), dodge(6.5, 118, -58), dodge(7.6, 110, -62)},
         {{0, 1.5}, {1, 0.55}},
         "LCx"},
        {"PDA",
         false,
         {dodge(6.2, 180, -66), dodge(6.9, 130, -75), dodge(7.6, 80, -76), dodge(8.8, 60, -68)},
         {{0, 1.9}, {1, 0.65}},
         "RCA"},
        {"PLV",
         false,
         {dodge(6.2, 180, -66), dodge(7.2, 155, -62), dodge(8.0, 145, -56), dodge(8.8, 132, -54)},
         {{0, 1.8}, {1, 0.6}},
         "RCA"},
        {"RV1",
         false,
         {dodge(3.2, -71, -38), dodge(4.3, -45, -42), dodge(5.6, -25, -45), dodge(7.0, -10, -48)},
         {{0, 1.4}, {1, 0.5}},
         "RCA"},
        {"AM",
         false,
         {dodge(5.7, -78, -61), dodge(6.2, -40, -64), dodge(7.2, -5, -62), dodge(8.4, 12, -58)},
         {{0, 1.3}, {1, 0.5}},
         "RCA"},
    };
  }();
  return all;
}

constexpr double lesion_at = 0.27;  // share of the stem's length

Vector3d outwards(const Vector3d& p) { return (p - heart_middle()).normalized(); }
Vector3d nowhere(const Vector3d&) { return Vector3d::Zero(); }

/// Height above the heart's surface.
double height(const Vector3d& p) {
  const Vector3d out = p - heart_middle();
  return out.norm() - heart_radius(out.normalized());
}

class Tree {
 public:
  std::vector<Course> courses;

  void add(const Stem& stem) {
    std::vector<Vector3d> through = stem.through;
    for (Vector3d& p : through) p += stem.left ? left_ostium() : right_ostium();
    Course course{stem.name, stem.left, smooth_line(through, course_step_m), {}, index_of(stem.from)};
    const bool main = stem.share_mm.size() > 2;
    const bool septal = stem.name[0] == 'S';
    if (!septal)  // closer to the surface, unless deep within
      for (Eigen::Index i = 0; i < course.line.cols(); ++i) {
        const Vector3d p = course.line.col(i);
        const double h = height(p), deep = std::clamp((-0.003 - h) / 0.009, 0.0, 1.0);
        course.line.col(i) += (1 - deep) * 0.65 * (0.0008 - h) * outwards(p);
      }
    if (course.parent >= 0) {  // the parent has wandered from the published point
      const Course& parent = at(course.parent);
      Eigen::Index nearest = 0;
      (parent.line.colwise() - course.line.col(0)).colwise().squaredNorm().minCoeff(&nearest);
      const Vector3d off = parent.line.col(nearest) - course.line.col(0);
      for (Eigen::Index i = 0; i < course.line.cols(); ++i)
        course.line.col(i) += std::exp(-double(i) * course_step_m / 0.012) * off;
    }
    wind(course.line, septal ? nowhere : outwards, main ? 1.1e-3 : septal ? 0.9e-3 : 1.25e-3, random_);
    course.radius_m = calibre(course.line.cols(), stem.share_mm, course.parent < 0 ? 0.0 : 0.3, random_);
    courses.push_back(std::move(course));
  }

  /// Adds a course's side twigs, their twigs, and its two terminal branches.
  void sprout(int parent, int generation) {
    const Eigen::Index n = at(parent).line.cols();
    const double length_m = double(n) * course_step_m;
    const bool septal = runs_within(parent);
    double side = random_.uniform(-1, 1) < 0 ? -1 : 1;
    for (double s = generation ? random_.uniform(0.004, 0.008) : random_.uniform(0.016, 0.024); s < 0.93 * length_m;
         s += random_.uniform(0.6, 1.4) * (generation == 0 ? 0.0085 : 0.0065)) {
      const auto from = static_cast<Eigen::Index>(s / course_step_m);
      const double radius_m = at(parent).radius_m[from] * random_.uniform(0.24, 0.5);
      side = random_.uniform(0, 1) < 0.75 ? -side : side;
      twig(parent, from, std::min(radius_m, 0.36e-3), side * random_.uniform(0.6, 1.15), septal, generation);
    }
    for (double turn : {-0.5, 0.6}) {
      const double radius_m = at(parent).radius_m[n - 1] * random_.uniform(0.7, 0.95);
      twig(parent, n - 1, radius_m, turn * random_.uniform(0.6, 1.3), septal, generation);
    }
  }

  /// Into the septum, from the LAD.
  void septals(int parent) {
    const Eigen::Index n = at(parent).line.cols();
    for (double share : {0.33, 0.44, 0.52, 0.61, 0.70, 0.79}) {
      const auto from = static_cast<Eigen::Index>((share + random_.uniform(-0.02, 0.02)) * double(n));
      const Vector3d p = at(parent).line.col(from), inwards = -outwards(p);
      const Vector3d goal = inwards + Vector3d(-0.35, -0.55, 0.1) + 0.25 * random_.vector();
      push("septal", parent, from, random_.uniform(0.22e-3, 0.4e-3), inwards + 0.4 * along(parent, from), goal,
           random_.uniform(0.018, 0.034), true, 1);
    }
  }

 private:
  const Course& at(int i) const { return courses[static_cast<std::size_t>(i)]; }
  int index_of(const char* name) const {
    for (std::size_t i = 0; i < courses.size(); ++i)
      if (courses[i].name == name) return static_cast<int>(i);
    return -1;
  }
  bool runs_within(int i) const { return at(i).name[0] == 'S' || at(i).name == "septal"; }
  Vector3d along(int i, Eigen::Index point) const {
    const Eigen::Matrix3Xd& line = at(i).line;
    const Eigen::Index last = std::min(point + 4, line.cols() - 1);
    return (line.col(last) - line.col(std::max<Eigen::Index>(last - 8, 0))).normalized();
  }

  void twig(int parent, Eigen::Index from, double radius_m, double turn_rad, bool septal, int generation) {
    if (radius_m < 0.085e-3) return;
    const Vector3d way = along(parent, from), p = at(parent).line.col(from);
    Vector3d about = outwards(p);
    if (septal) about = way.cross(random_.vector()).normalized();
    const Vector3d direction = Eigen::AngleAxisd(turn_rad, about) * way;
    const Vector3d goal = Eigen::AngleAxisd(0.6 * turn_rad, about) * way + Vector3d(0, -0.25, 0.1);
    push(septal ? "septal" : "twig", parent, from, radius_m, direction, goal,
         std::min(0.045, radius_m * random_.uniform(45, 85)), septal, generation + 1);
  }

  void push(const char* name, int parent, Eigen::Index from, double radius_m, const Vector3d& direction,
            const Vector3d& goal, double length_m, bool septal, int generation) {
    const Vector3d start = at(parent).line.col(from);
    const double first_m = height(start);
    const Bed surface = [&](const Vector3d& p) {
      const double kept_m = 0.0008 + (first_m - 0.0008) * std::exp(-(p - start).norm() / 0.020);
      const Vector3d out = (p - heart_middle()).normalized();
      return Vector3d(heart_middle() + (heart_radius(out) + kept_m) * out);
    };
    const Bed anywhere = [](const Vector3d& p) { return p; };
    const double curl_1_m = random_.uniform(70, 160);
    Course course{name, at(parent).left, {}, {}, parent};
    course.line = grow({start, direction, goal, length_m, curl_1_m}, septal ? nowhere : outwards,
                       septal ? anywhere : surface, random_);
    const double first_mm = 2e3 * radius_m;
    course.radius_m = calibre(
        course.line.cols(), {{0, first_mm}, {0.6, 0.72 * first_mm}, {1, std::min(0.15, 0.5 * first_mm)}}, 0.4, random_);
    courses.push_back(std::move(course));
    if (generation < 3 && radius_m > 0.17e-3) sprout(static_cast<int>(courses.size()) - 1, generation);
  }

  Random random_{11};
};

}  // namespace

Vector3d left_ostium() { return {-0.018, 0.042, -0.022}; }
Vector3d right_ostium() { return left_ostium() + 0.7 * dodge(3.7, -25, -23); }

std::vector<Course> coronaries(double stenosis) {
  static const std::vector<Course> healthy = [] {
    Tree tree;
    for (const Stem& stem : stems()) tree.add(stem);
    tree.septals(0);
    for (int i = 0; i < static_cast<int>(stems().size()); ++i) tree.sprout(i, 0);
    return tree.courses;
  }();
  std::vector<Course> out = healthy;
  for (Course& course : out)
    if (course.name == "LAD" || course.name == "RCA") {
      const Eigen::Index n = course.line.cols();
      const Eigen::ArrayXd off = (Eigen::ArrayXd::LinSpaced(n, 0, 1) - lesion_at) * double(n) * course_step_m / 0.006;
      course.radius_m.array() *= 1 - stenosis * (-off.square()).exp();
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

}  // namespace ostium::fluoro::phantom
