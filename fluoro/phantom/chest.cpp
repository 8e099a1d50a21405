#include "fluoro/phantom/chest.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "fluoro/matter/tissue.h"
#include "fluoro/phantom/coronaries.h"
#include "fluoro/phantom/heart.h"

namespace ostium::fluoro::phantom {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using units::pi;

namespace {

constexpr double midline_x = -0.022, spine_z = -0.098, chest_z = -0.022, vertebra_m = 0.0262;

/// Relative depth within a rounded ellipse of that half width and half depth: 1 at its middle, negative outside.
double across_chest(const Vector3d& p, double wide_m, double deep_m) {
  const double x = (p.x() - midline_x) / wide_m, z = (p.z() - chest_z) / deep_m;
  return 1 - std::pow(std::pow(std::fabs(x), 2.4) + std::pow(std::fabs(z), 2.4), 1 / 2.4);
}
constexpr double rib_wide_m = 0.1535, rib_deep_m = 0.0985;

/// Height of the diaphragm's domes.
double diaphragm_y(const Vector3d& p, bool right) {
  const double beside = p.x() - (right ? -0.10 : 0.075), z = p.z() / 0.12;
  const bool medial = (beside > 0) == right;  // slopes less towards the heart
  const double x = beside / (medial ? 0.125 : 0.085);
  return (right ? -0.045 : -0.060) - 0.06 * (x * x + z * z);
}

/// Course of the aorta beside the spine.
Vector3d descending_aorta(double y) {
  return {-0.004 + 0.006 * std::sin((y + 0.03) / 0.04), y, -0.081 + 0.003 * std::sin(y / 0.05)};
}

/// Signed distance to the lungs' surface, negative inside.
double from_lung(const Vector3d& p, bool right) {
  const double side = right ? midline_x - p.x() : p.x() - midline_x;
  // Wide around spine, aorta and heart; in front the lungs almost meet.
  const double front = std::clamp((p.z() - 0.005) / 0.05, 0.0, 1.0);
  const double mediastinum_m = 0.024 - 0.017 * front * front * (3 - 2 * front) +
                               0.01 * std::exp(-std::pow((p.y() - 0.04) / 0.05, 2)) +
                               0.0025 * std::sin(p.y() / 0.017 + p.z() / 0.03) + 0.002 * std::sin(p.z() / 0.014);
  const Vector3d from_middle = p - heart_middle();
  const double heart = from_middle.norm() - heart_radius(from_middle.normalized()) - 0.003;
  const double aorta = (p - descending_aorta(p.y())).norm() - 0.0145;
  // The structures the lung surrounds, with the grooves between them filled.
  const double solid = joined(joined(side - mediastinum_m, heart, 0.022), aorta, 0.010);
  const double base = p.y() - diaphragm_y(p, right), apex = 0.16 - p.y() - 6.6 * side * side;
  return -joined(std::min(0.1 * across_chest(p, 0.146, 0.091), apex), joined(solid, base, 0.035), 0.012);
}

/// Cortical shell round spongy bone.
void add_bone(std::vector<Body>& out, const std::string& name, const Surface& outer, const Surface& inner,
              Tissue marrow = tissue::spongy_bone) {
  out.push_back(body(name, outer, tissue::cortical_bone, tissue::soft));
  out.push_back(body(name + " marrow", inner, marrow, tissue::cortical_bone));
}

/// A thoracic vertebra about the middle of its body: millimetres, x to a side, y to the head, z to the front.
double from_vertebra_mm(Vector3d p) {
  p.x() = std::fabs(p.x());
  constexpr double wide = 16.2, high = 10.9, deep = 14.8;
  // Waisted, its end plates hollow, its back flat.
  const double waist = 1 - 0.10 * (1 - std::pow(p.y() / high, 2));
  const double z = p.z() > 0 ? p.z() / deep : p.z() / (deep - 2);
  const double out = std::pow(std::pow(p.x() / wide, 2.9) + std::pow(std::fabs(z), 2.7), 1 / 2.7) / waist;
  const double side = (out - 1) * 12.5, end = std::fabs(p.y()) - high + 1.3 * std::max(0.0, 1 - out * out);
  const double body = common(side, end, 3.5);
  const auto rod = [&](const Vector3d& a, const Vector3d& b, double radius_a, double radius_b, const Vector3d& scale) {
    return from_rod(p.cwiseProduct(scale), a.cwiseProduct(scale), b.cwiseProduct(scale), radius_a, radius_b) /
           scale.maxCoeff();
  };
  const Vector3d round = Vector3d::Ones();
  double arch = rod({9.5, 4, -9}, {10.5, 4.5, -22}, 3.1, 3.3, {1, 0.68, 1});           // pedicle
  arch = joined(arch, rod({11, 11, -23}, {11.5, -9, -25}, 3.6, 3.2, {1, 1, 1.3}), 4);  // articular processes
  arch = joined(arch, rod({11, 3, -25}, {0, -2, -33}, 2.4, 2.8, {1, 0.5, 1}), 3);      // lamina
  arch = joined(arch, rod({13, 4, -25}, {29, 8, -36}, 3.4, 4.0, round), 4);            // transverse process
  arch = joined(arch, rod({0, -2, -33}, {0, -21, -52}, 3.4, 3.8, {1.5, 0.9, 1}), 3);   // spinous process
  return joined(body, arch, 3);
}

void add_spine(std::vector<Body>& out) {
  const auto shape = [](double inset_mm) {
    return net([=](const Vector3d& p) { return 1e-3 * (from_vertebra_mm(1e3 * p) + inset_mm); },
               {-0.036, -0.0285, -0.061}, {0.036, 0.0165, 0.018}, 1.5e-3);
  };
  static const Surface outer = shape(0), inner = shape(0.85);
  Random random(5);
  for (int i = -6; i <= 6; ++i) {
    const double y = vertebra_m * i + 0.004;
    const Eigen::Affine3d at =
        Eigen::Translation3d(midline_x + 0.0007 * random.uniform(-1, 1), y, spine_z + 1.2 * y * y) *
        Eigen::AngleAxisd(-2.0 * y + 0.03 * random.uniform(-1, 1), Vector3d::UnitX()) *
        Eigen::AngleAxisd(0.035 * random.uniform(-1, 1), Vector3d::UnitZ()) *
        Eigen::AngleAxisd(0.05 * random.uniform(-1, 1), Vector3d::UnitY()) *
        Eigen::Scaling(1 + 0.03 * random.uniform(-1, 1) - 0.010 * i);
    const auto placed = [&](const Surface& local) {
      return Surface{local.triangles,
                     ((at.linear() * local.p_P.cast<double>()).colwise() + at.translation()).cast<float>()};
    };
    add_bone(out, "vertebra " + std::to_string(7 - i), placed(outer), placed(inner));
  }
}

/// From the head at the spine to the cartilage, where the cortex and the height taper off.
void add_ribs(std::vector<Body>& out) {
  Random random(3);
  for (int i = -5; i <= 6; ++i) {
    const double fall_m = 0.086 + 0.0035 * (3 - i) + 0.005 * random.uniform(-1, 1),
                 back = random.uniform(-0.002, 0.002);
    for (double side : {-1.0, 1.0}) {
      std::vector<Vector3d> through;
      const double back_y = vertebra_m * i + 0.013 + back, sway = random.uniform(-0.0025, 0.0025);
      through.emplace_back(midline_x + side * 0.0185, back_y - 0.004, spine_z - 0.011);
      for (int k = 0; k <= 16; ++k) {
        const double t = k / 16.0, angle = -0.40 * pi + t * (0.40 + 0.29) * pi;
        const double x = std::pow(std::cos(angle), 0.85) * rib_wide_m;
        const double z = chest_z + std::copysign(std::pow(std::fabs(std::sin(angle)), 0.85), angle) * rib_deep_m;
        // Level behind, steep at the side, gentler in front.
        const double fallen = t * t * (3 - 2 * t) * 0.75 + 0.25 * t;
        through.emplace_back(
            midline_x + side * x,
            back_y + 0.004 * std::sin(pi * std::min(1.0, 3 * t)) - fall_m * fallen + sway * std::sin(2 * pi * t), z);
      }
      const Matrix3Xd line = smooth_line(through, 0.004);
      Eigen::VectorXd half_height(line.cols()), cortex(line.cols());
      const double height = random.uniform(0.0042, 0.0055), thick = random.uniform(0.00032, 0.00050),
                   phase = random.uniform(0, 6);
      for (Eigen::Index k = 0; k < line.cols(); ++k) {
        const double t = double(k) / double(line.cols() - 1), front = std::clamp((t - 0.70) / 0.30, 0.0, 1.0);
        const double neck = std::clamp(t / 0.12, 0.0, 1.0);
        half_height[k] =
            height * (0.6 + 0.4 * neck) * (1 + 0.05 * std::sin(11 * t + phase)) * (1 - 0.85 * front * front * front);
        cortex[k] = thick * (1 - 0.93 * std::pow(front, 0.7));
      }
      const std::string name = "rib " + std::to_string(6 - i) + (side > 0 ? " left" : " right");
      const Vector3d outwards(side * 0.05, 0.0, -1);
      add_bone(out, name, tube(line, half_height, 16, true, 0.58, outwards),
               tube(line, half_height - cortex, 16, true, 0.50, outwards), tissue::loose_bone);
    }
  }
}

/// Spongy throughout: its cortex is thinner than a mesh would show.
double from_sternum_mm(const Vector3d& p) {  // x to a side, y along it, z through it
  const double y = p.y();
  // Manubrium above, angle of Louis, body with notches for the ribs.
  const double notches = 1.6 * std::sin(0.27 * y + 0.6) + 0.7 * std::sin(0.61 * y);
  const double wide = 15 + 9 / (1 + std::exp(-(y - 46) / 4)) - 3 * std::exp(-std::pow((y - 42) / 7, 2)) -
                      5 * std::clamp(-(y + 30) / 40, 0.0, 1.0) + notches;
  // Lens-shaped in cross-section, so that its margin is soft.
  const double across = 0.85 * (std::fabs(p.z()) - 5 * (1 - std::pow(p.x() / wide, 2)));
  return common(across, std::max(y - 78, -72 - y + 2.5 * std::cos(0.2 * p.x())), 14);
}

/// Arteries and veins of the lungs: a few from each hilum, ending at the fissures, branching unevenly.
void add_lung_vessels(std::vector<Body>& out) {
  Random random(7);
  const Normal nowhere = [](const Vector3d&) { return Vector3d(Vector3d::Zero()); };
  const Bed anywhere = [](const Vector3d& p) { return p; };
  for (bool right : {true, false}) {
    std::vector<Course> courses;
    const double side = right ? -1 : 1;
    const auto push = [&](int parent, const Vector3d& start, const Vector3d& direction, const Vector3d& goal,
                          double radius_m, double length_m) {
      Course course{right ? "right lung vessel" : "left lung vessel", !right, {}, {}, parent};
      course.line = grow({start, direction, goal, length_m, 60}, nowhere, anywhere, random);
      Eigen::Index inside = 0;
      while (inside < course.line.cols() && from_lung(course.line.col(inside), right) < -0.004) ++inside;
      if (inside < 16) return;
      course.line.conservativeResize(3, inside);
      course.radius_m = calibre(inside, {{0, 2e3 * radius_m}, {1, std::max(0.3, 1.0e3 * radius_m)}}, 0.1, random);
      courses.push_back(std::move(course));
    };
    const Vector3d hilum(midline_x + side * 0.047, 0.034, -0.036);
    for (const Vector3d& way : {Vector3d(0.35, 1, 0.2), Vector3d(0.6, 0.7, -0.5), Vector3d(1, 0.1, 0.5),
                                Vector3d(0.7, -0.5, 0.45), Vector3d(0.3, -1, -0.25), Vector3d(0.55, -0.8, -0.55)}) {
      const Vector3d towards = Vector3d(side * way.x(), way.y(), way.z()) + 0.25 * random.vector();
      Vector3d start = hilum + 0.016 * towards.normalized() + 0.004 * random.vector();
      for (int k = 0; k < 30 && from_lung(start, right) > -0.006; ++k) start += 0.002 * Vector3d(side, 0, 0);
      push(-1, start, towards, towards, random.uniform(0.0014, 0.0022), random.uniform(0.06, 0.10));
    }
    for (std::size_t i = 0; i < courses.size() && courses.size() < 220; ++i)
      for (double s = random.uniform(0.008, 0.014);; s += random.uniform(0.007, 0.015)) {
        const Course& parent = courses[i];
        const auto from = static_cast<Eigen::Index>(s / course_step_m);
        if (from + 4 >= parent.line.cols()) break;
        const double radius_m = parent.radius_m[from] * random.uniform(0.45, 0.85);
        if (radius_m < 0.0003) continue;
        const Vector3d along = (parent.line.col(from + 4) - parent.line.col(from)).normalized();
        const Vector3d aside = along.cross(random.vector()).normalized();
        const double turn = random.uniform(0.5, 1.1);
        const Vector3d start = parent.line.col(from);
        push(static_cast<int>(i), start, std::cos(turn) * along + std::sin(turn) * aside, along + 0.7 * aside, radius_m,
             radius_m * random.uniform(20, 34));
      }
    for (std::size_t i = 0; i < courses.size(); ++i)
      out.push_back(body(courses[i].name, lumen(courses, i).surface, tissue::blood, tissue::lung));
  }
}

std::vector<Body> fixed_bodies() {
  std::vector<Body> out;
  const auto trunk = [](const Vector3d& p) {
    return -std::min(0.1 * across_chest(p, 0.172, 0.132), 0.32 - std::fabs(p.y()));
  };
  out.push_back(
      body("trunk", net(trunk, {-0.22, -0.34, -0.175}, {0.18, 0.34, 0.13}, 0.008), tissue::soft, tissue::air));
  for (bool right : {true, false}) {
    const double low = right ? -0.18 : -0.03, high = right ? -0.01 : 0.14;
    const auto lung = [=](const Vector3d& p) { return from_lung(p, right); };
    out.push_back(body(right ? "right lung" : "left lung", net(lung, {low, -0.21, -0.13}, {high, 0.17, 0.085}, 0.0035),
                       tissue::lung, tissue::soft));
  }
  add_spine(out);
  add_ribs(out);
  const auto sternum = [](const Vector3d& p) {
    const Vector3d local = 1e3 * (p - Vector3d(midline_x, 0.03, 0.078));
    return 1e-3 *
           from_sternum_mm({local.x(), local.y(), local.z() + 0.12 * local.y() + 0.0012 * local.y() * local.y()});
  };
  out.push_back(body("sternum", net(sternum, {midline_x - 0.035, -0.06, 0.055}, {midline_x + 0.035, 0.12, 0.1}, 0.002),
                     tissue::loose_bone, tissue::soft));
  add_lung_vessels(out);
  // Lies in the mediastinum and is visible against the left lung.
  const Matrix3Xd aorta = smooth_line({descending_aorta(-0.25),
                                       descending_aorta(-0.17),
                                       descending_aorta(-0.10),
                                       descending_aorta(-0.05),
                                       descending_aorta(0),
                                       descending_aorta(0.05),
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
                         heart_middle(), [](const Vector3d& d) { return heart_radius(d); }, 48),
                     tissue::muscle, tissue::soft));
  const std::vector<Course> courses = coronaries(options.stenosis);
  for (std::size_t i = 0; i < courses.size(); ++i) {
    const Course& course = courses[i];
    if (!filled(options.filling, course.left)) continue;
    const auto [surface, point] = lumen(courses, i);
    Body vessel = body(course.name, surface, tissue::soft, tissue::soft);
    // Contrast that refluxes into the aorta thins out upstream of the ostium; elsewhere the filling is uniform, and
    // concentration times distance is integrated from the far end.
    const Eigen::Index last = course.line.cols() - 1;
    const auto iodine = [&](Eigen::Index k) {
      const double t = course.parent < 0 ? std::min(1.0, double(k) / double(mouth_points)) : 1;
      return options.iodine_kg_m3 * t * t * (3 - 2 * t);
    };
    Matrix3Xd along = options.iodine_kg_m3 * course.line;
    for (Eigen::Index k = last; k-- > 0;)
      along.col(k) =
          along.col(k + 1) - 0.5 * (iodine(k) + iodine(k + 1)) * (course.line.col(k + 1) - course.line.col(k));
    vessel.contrast.iodine_kg_m3.resize(point.size());
    vessel.contrast.p_PC.resize(3, point.size());
    vessel.contrast.along_kg_m2.resize(3, point.size());
    for (Eigen::Index k = 0; k < point.size(); ++k) {
      vessel.contrast.iodine_kg_m3[k] = static_cast<float>(iodine(point[k]));
      vessel.contrast.p_PC.col(k) = course.line.col(point[k]).cast<float>();
      vessel.contrast.along_kg_m2.col(k) = along.col(point[k]).cast<float>();
    }
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
  const Course vessel = coronaries(0)[options.left_instruments ? 0 : 2];
  const Vector3d ostium = vessel.line.col(mouth_points);
  // Judkins' curves: from the arch along the far wall of the ascending aorta, then across to the ostium.
  const auto off = [&](double x_mm, double y_mm, double z_mm) {
    return Vector3d(ostium + 1e-3 * Vector3d(x_mm, y_mm, z_mm));
  };
  std::vector<Vector3d> way =
      options.left_instruments
          ? std::vector<Vector3d>{off(-0.5, 0, 0.3), off(-6, -2, 3), off(-13, -2.5, 6.5), off(-19, 3, 10),
                                  off(-23, 14, 13)}
          : std::vector<Vector3d>{off(0.3, 0.2, -0.3), off(5, 1.2, -3), off(9, 6, -6), off(8, 16, -8)};
  way.insert(way.end(), {{-0.042, 0.080, 0.0},
                         {-0.034, 0.1, -0.002},
                         {-0.014, 0.118, -0.03},
                         {0.001, 0.10, -0.062},
                         descending_aorta(0.05),
                         descending_aorta(-0.10),
                         descending_aorta(-0.25)});
  const Matrix3Xd line = smooth_line(way, 0.001);
  const bool contrast = filled(options.filling, options.left_instruments);
  std::vector<Shaft> out{guide(line, contrast ? 0.9 * options.iodine_kg_m3 : 0)};

  const Eigen::Index tip = static_cast<Eigen::Index>(0.8 * double(vessel.line.cols()));
  const Eigen::Index within = tip - mouth_points;  // points beyond the ostium
  Matrix3Xd wire(3, within + line.cols());
  for (Eigen::Index i = 0; i < within; ++i) wire.col(i) = vessel.line.col(tip - 1 - i);
  wire.rightCols(line.cols()) = line;
  Shaft guidewire{"wire", wire, {}, 0, {}};
  // A coil in 0.356 mm over 20 cm of ground core, platinum (0.044 mm2) in the first 3 cm, then steel, as workhorse
  // wires have [from memory]; then the bare core.
  guidewire.sections = {{0, 0.03, Material::platinum, 0.178e-3, 0.1e-3, 0.63},
                        {0, 0.03, Material::steel, 0.04e-3, 0, 1},
                        {0.03, 0.2, Material::steel, 0.178e-3, 0.1e-3, 0.63},
                        {0.03, 0.1, Material::steel, 0.08e-3, 0, 1},
                        {0.1, 0.35, Material::steel, 0.1e-3, 0, 1},
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

}  // namespace ostium::fluoro::phantom
