#include "vascular/twigs/twigs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/fields.h"
#include "core/base/units.h"
#include "vascular/geometry/implicit/draws.h"
#include "vascular/motion/heart_cycle.h"
#include "vascular/motion/heart_motion.h"
#include "vascular/thorax/shapes.h"

namespace ostium::vascular {

namespace {

using Eigen::Vector3d;
using units::mm, units::pi;

constexpr double step_m = 1.5 * mm;
constexpr double finest_m = 0.3 * mm;  // diameter at which a twig ends
constexpr double law = 7.0 / 3;
constexpr int sides = 4;

/// How a twig sets out.
struct Start {
  Vector3d p, heading;
  double diameter_m = 0;
  int root = 0;
  bool septal = false;
};

class Growth {
 public:
  Growth(const Patient& patient, std::uint64_t seed)
      : patient_(patient), motion_(patient.anatomy.landmarks), draw_(seed) {
    for (std::size_t v = 0; v < patient.lumen.moving; ++v) rest_.push_back(patient.lumen.healthy(v, 0, 0));
  }

  Twigs grow() {
    const auto& branches = patient_.tree.branches;
    std::vector<bool> coronary(branches.size(), false);
    for (std::size_t b = 0; b < branches.size(); ++b) {
      const int parent = branches[b].parent;
      coronary[b] = branches[b].name == "LM" || branches[b].name == "RCA" ||
                    (parent >= 0 && coronary[static_cast<std::size_t>(parent)]);
      if (coronary[b] && branches[b].spheres.size() > 4) along(branches[b]);
    }
    begin_twig();
    return std::move(twigs_);
  }

 private:
  /// Away from the left ventricle's axis.
  Vector3d outwards(const Vector3d& p) const { return from_axis(p).normalized(); }
  Vector3d from_axis(const Vector3d& p) const {
    const Landmarks& m = patient_.anatomy.landmarks;
    const Vector3d axis = m.p_lv_apex - m.p_lv_base;
    const double s = std::clamp((p - m.p_lv_base).dot(axis) / axis.squaredNorm(), -0.2, 0.85);
    return p - m.p_lv_base - s * axis;
  }

  int nearest_vertex(const Vector3d& p) const {
    int best = 0;
    double least = 1;
    for (std::size_t v = 0; v < rest_.size(); ++v) {
      const double d = (rest_[v] - p).squaredNorm();
      if (d < least) least = d, best = static_cast<int>(v);
    }
    return best;
  }

  void along(const TreeBranch& branch) {
    const auto& spheres = branch.spheres;
    const auto tangent = [&](std::size_t i) {
      return Vector3d((spheres[std::min(i + 1, spheres.size() - 1)].p - spheres[i ? i - 1 : 0].p).normalized());
    };
    double next = spheres.front().s_m + 3 * spheres.front().radius_m + draw_.between(2, 6) * mm;
    double side = draw_.uniform() < 0.5 ? -1 : 1;
    const bool septals = branch.name == "LAD";
    for (std::size_t i = 1; i + 2 < spheres.size(); ++i) {
      if (spheres[i].s_m < next) continue;
      next = spheres[i].s_m + draw_.between(6, 16) * mm;
      side = -side;
      const double parent_m = 2 * spheres[i].radius_m;
      const Vector3d out = outwards(spheres[i].p), across = side * out.cross(tangent(i)).normalized();
      Start start{spheres[i].p,
                  {},
                  std::clamp(parent_m * draw_.between(0.16, 0.36), 0.34 * mm, 0.85 * mm),
                  nearest_vertex(spheres[i].p),
                  septals && draw_.uniform() < 0.55};
      start.heading = start.septal ? Vector3d(0.35 * tangent(i) - out + 0.2 * across)
                                   : Vector3d(draw_.between(0.2, 0.9) * tangent(i) + across);
      start.heading.normalize();
      start.p += 0.7 * spheres[i].radius_m * start.heading;
      element(start, 0);
    }
    // The end goes on in two, rather than being cut.
    const std::size_t last = spheres.size() - 1;
    const double end_m = std::min(1.8 * spheres[last].radius_m, 1.6 * mm);
    split({spheres[last].p - spheres[last].radius_m * tangent(last), tangent(last), end_m,
           nearest_vertex(spheres[last].p), false},
          0);
  }

  void split(const Start& from, int generation) {
    const double ratio = draw_.between(0.45, 1), large = from.diameter_m / std::pow(1 + std::pow(ratio, law), 1 / law);
    const Vector3d out = outwards(from.p);
    double turn = (draw_.uniform() < 0.5 ? -1 : 1) * draw_.between(0.2, 0.5);
    for (double diameter : {large, ratio * large}) {
      if (diameter > 0.85 * finest_m) {
        Start start = from;
        start.diameter_m = diameter;
        start.heading = Eigen::AngleAxisd(turn, out) * from.heading;
        element(start, generation + 1);
      }
      turn = -turn * draw_.between(1.2, 2.5);
    }
  }

  /// From a division to the next.
  void element(const Start& from, int generation) {
    const bool is_last = from.diameter_m < 1.25 * finest_m || generation > 7;
    const double length = from.diameter_m * std::min(draw_.between(14, 26), 18 * mm / from.diameter_m) *
                              (from.septal ? 1.6 : 1) * (is_last ? 1.3 : 1) +
                          2 * mm;
    const int steps = std::max(3, static_cast<int>(length / step_m));
    const double height = from_axis(from.p).norm();
    std::vector<Vector3d> line{from.p};
    std::vector<double> radius{0.5 * from.diameter_m};
    Vector3d heading = from.heading, bend = Vector3d::Zero(), turned = bend;
    for (int i = 1; i <= steps; ++i) {
      const Vector3d p = line.back(), out = outwards(p);
      bend = 0.55 * bend - 0.06 * turned + (from.septal ? 0.06 : 0.16) * draw_.normals();
      turned += bend;
      heading += bend;
      if (!from.septal) heading += (-heading.dot(out) + 0.15 * (height - from_axis(p).norm()) / mm) * out;
      heading.normalize();
      line.push_back(p + step_m * heading);
      const double t = static_cast<double>(i) / steps, fade = is_last ? 1 - 0.85 * t * t : 1 - 0.06 * t;
      radius.push_back(0.5 * from.diameter_m * fade * (1 + 0.07 * draw_.normal()));
    }
    add(line, radius, from.root);
    if (is_last) return;
    split({line.back(), heading, from.diameter_m, from.root, from.septal}, generation);
  }

  void add(const std::vector<Vector3d>& line, const std::vector<double>& radius, int root) {
    const Vector3d of_root = motion_.displacement(patient_.lumen.healthy(static_cast<std::size_t>(root), 0, 0));
    const Mesh one = rod(line, radius, sides);
    begin_twig();
    twigs_.root.push_back(root);
    twigs_.diameter_m.push_back(2 * radius.front());
    for (const Vector3d& p : one.vertices) twigs_.beat.push_back(motion_.displacement(p) - of_root);
    append(twigs_.mesh, one);
  }

  void begin_twig() {
    twigs_.first.push_back(static_cast<int>(twigs_.mesh.vertices.size()));
    twigs_.first_triangle.push_back(static_cast<int>(twigs_.mesh.triangles.size()));
  }

  const Patient& patient_;
  HeartMotion motion_;
  Draws draw_;
  std::vector<Vector3d> rest_;  ///< the lumen's moving vertices at end-diastole
  Twigs twigs_;
};

}  // namespace

Twigs grow_twigs(const Patient& patient) {
  const Landmarks& marks = patient.anatomy.landmarks;
  return Growth(patient, core::hash_numbers(std::span<const double>(marks.p_lv_base.data(), 3), 1)).grow();
}

void at(const Twigs& twigs, std::size_t twig, const MovingLumen& lumen, double phase, double breath,
        std::vector<Vector3d>& out) {
  out.clear();
  const double contracted = contraction(phase);
  const auto root = static_cast<std::size_t>(twigs.root[twig]);
  const Vector3d shift = lumen.healthy(root, phase, breath) - lumen.healthy(root, 0, 0);
  for (int i = twigs.first[twig]; i < twigs.first[twig + 1]; ++i) {
    const auto v = static_cast<std::size_t>(i);
    out.push_back(twigs.mesh.vertices[v] + shift + contracted * twigs.beat[v]);
  }
}

}  // namespace ostium::vascular
