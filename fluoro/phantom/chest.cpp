#include "fluoro/phantom/chest.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "fluoro/phantom/coronaries.h"
#include "fluoro/tissue.h"

namespace ostium::phantom {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;
constexpr double pi = std::numbers::pi;

namespace {

using Implicit = std::function<double(const Vector3d&)>;  // positive inside

constexpr double midline_x = -0.022, spine_z = -0.105, chest_z = -0.022;

/// The surface of an implicit shape as seen from `centre`, which is inside: where a ray first leaves.
Surface seen_from(const Vector3d& centre, const Implicit& inside, double farthest_m, int rings) {
  const auto radius = [&](const Vector3d& d) {
    constexpr double step = 0.002;
    double r = step;
    while (r < farthest_m && inside(centre + r * d) > 0) r += step;
    double low = r - step, high = r;
    for (int i = 0; i < 12; ++i) {
      const double middle = 0.5 * (low + high);
      (inside(centre + middle * d) > 0 ? low : high) = middle;
    }
    return low;
  };
  return star(centre, radius, rings);
}

/// Elliptic cross-section, as a distance in shares of the half width.
double in_trunk(const Vector3d& p, double inset_m) {
  const double x = (p.x() - midline_x) / (0.168 - inset_m), z = (p.z() - chest_z) / (0.112 - inset_m);
  return 1 - std::pow(std::pow(std::fabs(x), 2.4) + std::pow(std::fabs(z), 2.4), 1 / 2.4);
}

const Vector3d heart_middle(0.004, -0.004, 0.004);

/// Round every epicardial point: the hull of spheres that have centre and point as poles.
double heart_radius(const Vector3d& direction) {
  static const std::vector<Vector3d> points = [] {
    std::vector<Vector3d> all = epicardial_points();
    all.emplace_back(-0.052, -0.015, 0.02);  // right atrium
    all.emplace_back(-0.05, -0.035, 0.018);
    all.emplace_back(-0.02, 0.05, 0.03);  // outflow
    return all;
  }();
  double sum = 0;
  for (const Vector3d& p : points) sum += std::exp(700 * std::max(0.0, (p - heart_middle).dot(direction)));
  return std::log(sum / 2.0) / 700 + 0.003;
}

double in_heart(const Vector3d& p, double margin_m) {
  const Vector3d from = p - heart_middle;
  return heart_radius(from.normalized()) + margin_m - from.norm();
}

/// Height of the diaphragm's domes.
double diaphragm_y(const Vector3d& p, bool right) {
  const double x = (p.x() - (right ? -0.10 : 0.075)) / 0.085, z = (p.z() - 0.0) / 0.12;
  return (right ? -0.045 : -0.060) - 0.06 * (x * x + z * z);
}

double in_lung(const Vector3d& p, bool right) {
  const double side = right ? midline_x - p.x() : p.x() - midline_x;
  const double mediastinum_m = 0.024 + 0.01 * std::exp(-std::pow((p.y() - 0.04) / 0.05, 2));
  double inside = 0.1 * in_trunk(p, 0.022);
  inside = std::min(inside, side - mediastinum_m);
  inside = std::min(inside, -in_heart(p, 0.004));
  inside = std::min(inside, p.y() - diaphragm_y(p, right));
  return std::min(inside, 0.16 - p.y() - 2.2 * side * side * 3);
}

/// Cortical shell round spongy bone.
void add_bone(std::vector<Body>& out, const std::string& name, const Surface& outer, const Surface& inner) {
  out.push_back(body(name, outer, tissue::cortical_bone, tissue::soft));
  out.push_back(body(name + " marrow", inner, tissue::spongy_bone, tissue::cortical_bone));
}

void add_spine(std::vector<Body>& out) {
  for (int i = -5; i <= 5; ++i) {
    const std::string name = "vertebra " + std::to_string(i + 6);
    const Vector3d middle(midline_x, 0.0285 * i + 0.004, spine_z);
    const Vector3d size(0.0185, 0.0118, 0.0150);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.015 * i, Vector3d::UnitX()).matrix();
    // Waisted, with raised end plates.
    const auto body_shape = [&](double shell) {
      return [=](const Vector3d& d) {
        const Vector3d local = turn.transpose() * d;
        const Vector3d s = size - Vector3d::Constant(shell);
        const double boxy =
            std::pow(std::pow(std::fabs(local.x()) / s.x(), 5) + std::pow(std::fabs(local.y()) / s.y(), 5) +
                         std::pow(std::fabs(local.z()) / s.z(), 3.2),
                     -1 / 4.6);
        return boxy * (1 - 0.07 * (1 - std::pow(std::min(1.0, std::fabs(local.y()) * boxy / s.y()), 2)));
      };
    };
    add_bone(out, name, star(middle, body_shape(0), 28), star(middle, body_shape(0.0009), 28));
    for (double side : {-1.0, 1.0}) {  // pedicles, articular masses, transverse processes
      const Vector3d root = middle + Vector3d(side * 0.011, 0.0045, -0.017);
      const auto axis_shape = [&](double r, double shell) {
        return ellipsoid(root, Vector3d(0.0042, 0.0062, 0.0090) * r - Vector3d::Constant(shell), 12);
      };
      add_bone(out, name + " pedicle", axis_shape(1, 0), axis_shape(1, 0.0011));
      const Matrix3Xd process =
          smooth_line({root + Vector3d(side * 0.003, 0, -0.008), root + Vector3d(side * 0.016, 0.003, -0.015),
                       root + Vector3d(side * 0.026, 0.004, -0.018)},
                      0.002);
      const Eigen::VectorXd radius = Eigen::VectorXd::LinSpaced(process.cols(), 0.0048, 0.0035);
      add_bone(out, name + " transverse process", tube(process, radius, 12),
               tube(process, radius - Eigen::VectorXd::Constant(process.cols(), 0.0009), 12));
    }
    const Vector3d spinous = middle + Vector3d(0, -0.009, -0.042);
    const Eigen::Matrix3d down = Eigen::AngleAxisd(-0.5, Vector3d::UnitX()).matrix();
    add_bone(out, name + " spinous process", ellipsoid(spinous, {0.0034, 0.0065, 0.017}, 12, down),
             ellipsoid(spinous, {0.0024, 0.0055, 0.016}, 12, down));
  }
}

void add_ribs(std::vector<Body>& out) {
  for (int i = -5; i <= 6; ++i)
    for (double side : {-1.0, 1.0}) {
      std::vector<Vector3d> through;
      const double back_y = 0.0285 * i + 0.016, fall_m = 0.075 + 0.004 * (3 - i), wall_m = 0.014;
      for (int k = 0; k <= 12; ++k) {
        const double t = k / 12.0, angle = -0.43 * pi + t * (0.43 + 0.33) * pi;  // from beside the spine to the front
        const double x = std::pow(std::fabs(std::cos(angle)), 0.85) * (0.168 - wall_m);
        const double z = chest_z + std::copysign(std::pow(std::fabs(std::sin(angle)), 0.85), angle) * (0.112 - wall_m);
        through.emplace_back(midline_x + side * x, back_y - fall_m * std::pow(t, 1.25) + 0.006 * std::sin(pi * t), z);
      }
      const Matrix3Xd line = smooth_line(through, 0.004);
      const Eigen::VectorXd radius = Eigen::VectorXd::Constant(line.cols(), 0.0066);
      const std::string name = "rib " + std::to_string(6 - i) + (side > 0 ? " left" : " right");
      const Vector3d outwards(side * 0.05, 0.0, -1);
      add_bone(out, name, tube(line, radius, 14, true, 0.5, outwards),
               tube(line, radius - Eigen::VectorXd::Constant(line.cols(), 0.0008), 14, true, 0.42, outwards));
    }
}

/// Vessels of the lungs: from the hilum outwards, halving.
void add_lung_vessels(std::vector<Body>& out) {
  std::mt19937 random(7);
  const auto uniform = [&](double low, double high) { return low + (high - low) * (double(random()) / 4294967296.0); };
  for (bool right : {true, false}) {
    struct Twig {
      Vector3d from, direction;
      double radius_m;
      int generation;
    };
    std::vector<Twig> twigs;
    const Vector3d hilum(midline_x + (right ? -0.045 : 0.050), 0.035, -0.035);
    for (int i = 0; i < 9; ++i)
      twigs.push_back(
          {hilum, Vector3d((right ? -1 : 1) * uniform(0.2, 1), uniform(-1.1, 0.9), uniform(-0.9, 0.9)).normalized(),
           uniform(0.0017, 0.0030), 0});
    for (std::size_t i = 0; i < twigs.size(); ++i) {
      const Twig twig = twigs[i];
      const double length = uniform(0.022, 0.036) * std::pow(0.86, twig.generation);
      const Vector3d bend = twig.direction.cross(Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
      const Vector3d middle = twig.from + 0.5 * length * twig.direction + 0.10 * length * bend,
                     end = twig.from + length * twig.direction + 0.12 * length * bend;
      if (in_lung(twig.from, right) < 0.001 || in_lung(end, right) < 0.003 || in_lung(middle, right) < 0.002) continue;
      const Matrix3Xd line = smooth_line({twig.from, middle, end}, 0.004);
      const Eigen::VectorXd radius = Eigen::VectorXd::LinSpaced(line.cols(), twig.radius_m, 0.82 * twig.radius_m);
      out.push_back(
          body(right ? "right lung vessel" : "left lung vessel", tube(line, radius, 8), tissue::blood, tissue::lung));
      if (twig.generation == 5) continue;
      for (int child = 0; child < 2; ++child) {
        const Vector3d turned =
            (end - middle).normalized() + 0.75 * Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        twigs.push_back({end, turned.normalized(), twig.radius_m * uniform(0.62, 0.80), twig.generation + 1});
      }
    }
  }
}

std::vector<Body> fixed_bodies() {
  std::vector<Body> out;
  const auto trunk = [](const Vector3d& p) { return std::min(0.1 * in_trunk(p, 0), 0.32 - std::fabs(p.y())); };
  out.push_back(body("trunk", seen_from({midline_x, 0, chest_z}, trunk, 0.5, 120), tissue::soft, tissue::air));
  out.push_back(body("right lung",
                     seen_from(
                         {-0.105, 0.03, -0.03}, [](const Vector3d& p) { return in_lung(p, true); }, 0.25, 110),
                     tissue::lung, tissue::soft));
  out.push_back(body("left lung",
                     seen_from(
                         {0.085, 0.03, -0.055}, [](const Vector3d& p) { return in_lung(p, false); }, 0.25, 110),
                     tissue::lung, tissue::soft));
  add_spine(out);
  add_ribs(out);
  const Vector3d sternum(midline_x, 0.03, 0.078);
  add_bone(out, "sternum", ellipsoid(sternum, {0.016, 0.075, 0.0055}, 24, Eigen::Matrix3d::Identity(), 3),
           ellipsoid(sternum, {0.0152, 0.0742, 0.0046}, 24, Eigen::Matrix3d::Identity(), 3));
  add_lung_vessels(out);
  // Stands in the mediastinum and shows where the left lung lies against it.
  const Matrix3Xd aorta = smooth_line({{0.002, -0.25, -0.080},
                                       {0.002, -0.05, -0.078},
                                       {0.003, 0.06, -0.070},
                                       {-0.004, 0.105, -0.045},
                                       {-0.018, 0.112, -0.02},
                                       {-0.032, 0.09, 0.0},
                                       {-0.034, 0.06, 0.0}},
                                      0.004);
  out.push_back(
      body("aorta", tube(aorta, Eigen::VectorXd::Constant(aorta.cols(), 0.0125), 24), tissue::blood, tissue::soft));
  return out;
}

bool filled(Filling filling, bool left) {
  return filling == Filling::both || filling == (left ? Filling::left : Filling::right);
}

std::vector<Body> moving_bodies(const ChestOptions& options) {
  std::vector<Body> out;
  out.push_back(body("heart",
                     star(
                         heart_middle, [](const Vector3d& d) { return heart_radius(d); }, 60),
                     tissue::muscle, tissue::soft));
  constexpr int sides = 16;
  for (const Course& course : coronaries(options.stenosis)) {
    if (!filled(options.filling, course.left)) continue;
    Body vessel = body(course.name, tube(course.line, course.radius_m, sides), tissue::soft, tissue::soft);
    vessel.contrast = {Eigen::VectorXf::Constant(vessel.p_P.cols(), static_cast<float>(options.iodine_kg_m3)),
                       tube_centres(course.line, sides)};
    out.push_back(std::move(vessel));
  }
  return out;
}

Shaft guide(const Matrix3Xd& line, double iodine_kg_m3) {
  Shaft shaft{"guide", line, {}, 0.9e-3, {}};
  shaft.sections = {{0, 0.0015, Material::polymer, 1.0e-3, 0.9e-3, 1},
                    {0.0015, 1.0, Material::polymer_barium, 1.0e-3, 0.9e-3, 1},
                    {0.003, 1.0, Material::steel, 0.965e-3, 0.935e-3, 0.35}};  // braid
  if (iodine_kg_m3 > 0) shaft.lumen_iodine_kg_m3 = Eigen::VectorXd::Constant(line.cols(), iodine_kg_m3);
  return shaft;
}

std::vector<Shaft> instruments(const ChestOptions& options) {
  const Vector3d ostium = options.left_instruments ? left_ostium() : right_ostium();
  const Vector3d inwards = options.left_instruments ? Vector3d(-0.7, 0.1, 0.35) : Vector3d(0.75, 0.25, -0.5);
  const Course vessel = coronaries(0)[options.left_instruments ? 0 : 2];
  std::vector<Vector3d> way{ostium + 0.003 * (vessel.line.col(6) - vessel.line.col(0)).normalized(),
                            ostium + 0.006 * inwards,
                            ostium + 0.014 * inwards + Vector3d(0, 0.006, 0),
                            {-0.042, 0.075, 0.0},
                            {-0.034, 0.1, -0.002},
                            {-0.014, 0.118, -0.03},
                            {0.004, 0.10, -0.06},
                            {0.008, 0.05, -0.074},
                            {0.006, -0.10, -0.078},
                            {0.004, -0.25, -0.08}};
  const Matrix3Xd line = smooth_line(way, 0.001);
  const bool contrast = filled(options.filling, options.left_instruments);
  std::vector<Shaft> out{guide(line, contrast ? 0.9 * options.iodine_kg_m3 : 0)};

  const Eigen::Index tip = static_cast<Eigen::Index>(0.8 * double(vessel.line.cols()));
  Matrix3Xd wire(3, tip + line.cols());
  for (Eigen::Index i = 0; i < tip; ++i) wire.col(i) = vessel.line.col(tip - 1 - i);
  wire.rightCols(line.cols()) = line;
  Shaft guidewire{"wire", wire, {}, 0, {}};
  // Platinum coil of 0.044 mm2 in 0.356 mm over 3 cm, then the ground core.
  guidewire.sections = {{0, 0.03, Material::platinum, 0.178e-3, 0.1e-3, 0.63},
                        {0, 0.03, Material::steel, 0.04e-3, 0, 1},
                        {0.03, 0.1, Material::steel, 0.095e-3, 0, 1},
                        {0.1, 0.35, Material::steel, 0.12e-3, 0, 1},
                        {0.35, 2.0, Material::steel, 0.165e-3, 0, 1}};
  out.push_back(guidewire);
  Shaft balloon{"balloon", wire, {}, 0, {}};
  const double at = 0.5e-3 * double(tip) - 0.27 * 0.5e-3 * double(vessel.line.cols());
  for (double marker : {at - 0.0075, at + 0.0075})
    balloon.sections.push_back({marker - 0.0005, marker + 0.0005, Material::platinum, 0.42e-3, 0.34e-3, 1});
  balloon.sections.push_back({at - 0.012, at + 0.25, Material::polymer, 0.42e-3, 0.27e-3, 1});
  balloon.sections.push_back({at + 0.25, 2.0, Material::steel, 0.32e-3, 0.25e-3, 1});
  out.push_back(balloon);
  return out;
}

}  // namespace

Scene chest(const ChestOptions& options) {
  static const auto fixed = std::make_shared<const std::vector<Body>>(fixed_bodies());
  Scene scene{fixed, moving_bodies(options), {}};
  if (options.instruments) scene.shafts = instruments(options);
  return scene;
}

Lesion lesion(bool left) {
  const Course course = coronaries(0)[left ? 0 : 2];
  const auto at = static_cast<Eigen::Index>(0.27 * double(course.line.cols() - 1));
  return {course.line.col(at), 2 * course.radius_m[at]};
}

}  // namespace ostium::phantom
