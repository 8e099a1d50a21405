/// The generated anatomy against published numbers. If a source gives a standard deviation, it is the tolerance.
#include <algorithm>
#include <cmath>

#include "app/gates/dodge.h"
#include "app/gates/gate.h"
#include "core/base/units.h"
#include "fluoro/projection/c_arm.h"
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"
#include "vascular/geometry/mesh/surface_check.h"
#include "vascular/motion/heart_cycle.h"
#include "vascular/patient/patient.h"

namespace ostium::app::gates {

namespace {

using units::per_mm, units::degree;

const vascular::NamedBranch& branch(const vascular::Anatomy& anatomy, const char* name) {
  return *find_branch(anatomy, name);
}

double origin_s(const vascular::Anatomy& anatomy, const char* child, const char* parent) {
  return nearest_s(anatomy.tubes[branch(anatomy, parent).tube],
                   anatomy.tubes[branch(anatomy, child).tube].nodes.front().p);
}

/// Diameter of the largest sphere that fits into the surface, `from_mm` beyond a branch's origin.
double diameter_mm(const vascular::Anatomy& anatomy, const vascular::BoundingVolumeHierarchy& wall, const char* name,
                   double from_mm) {
  const vascular::NamedBranch& b = branch(anatomy, name);
  return 2 * per_mm * wall.nearest(anatomy.tubes[b.tube].at(b.from_m + from_mm / per_mm).p, 0.05).distance_m;
}

double diameter_at_mm(const vascular::Anatomy& anatomy, const vascular::BoundingVolumeHierarchy& wall, int tube,
                      const Eigen::Vector3d& p_mm) {
  const vascular::Tube& t = anatomy.tubes[tube];
  return 2 * per_mm * wall.nearest(t.at(nearest_s(t, p_mm / per_mm)).p, 0.05).distance_m;
}

/// Mean direction of a branch between two distances from `s`, mm.
Eigen::Vector3d direction(const vascular::Tube& tube, double s_m, double from_mm, double to_mm) {
  return (tube.at(s_m + to_mm / per_mm).p - tube.at(s_m + from_mm / per_mm).p).normalized();
}

double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0)) / degree;
}

/// Mean distance from the middle of a sinus to the opposite commissure, over the three sinuses.
double sinus_mm(const vascular::Anatomy& anatomy, const vascular::BoundingVolumeHierarchy& wall) {
  const vascular::Landmarks& marks = anatomy.landmarks;
  const double height = 13e-3;
  const Eigen::Vector3d middle = marks.p_annulus + height * marks.root_axis;
  const auto to_wall = [&](const Eigen::Vector3d& direction) {
    // Sphere tracing outwards from the axis.
    double t = 0;
    for (int i = 0; i < 200; ++i) {
      const double d = wall.nearest(middle + t * direction, 0.05).distance_m;
      if (d < 1e-6) break;
      t += d;
    }
    return t;
  };
  double sum = 0;
  for (const char* name : {"left sinus", "right sinus", "non-coronary sinus"}) {
    const Eigen::Vector3d out = anatomy.tubes[branch(anatomy, name).tube].nodes.front().p - marks.p_annulus;
    const Eigen::Vector3d across = (out - out.dot(marks.root_axis) * marks.root_axis).normalized();
    sum += to_wall(across) + to_wall(-across);
  }
  return per_mm * sum / 3;
}

struct Motion {
  double plane_mean_mm_s = 0, plane_fastest_mm_s = 0, rest_ms = 0;
  std::array<double, 10> by_tenth_mm_s{};
};

/// Motion of the middle third of a branch at 70 beats a minute: speed in the transverse plane, as seen by electron beam
/// CT, and the longest time it stays within 1 mm.
Motion motion_of(const vascular::Anatomy& anatomy, const vascular::TubeMotion& motion, const char* name) {
  const vascular::NamedBranch& b = branch(anatomy, name);
  constexpr int places = 9, samples = 240;
  constexpr double rate = 70;
  std::vector<std::vector<Eigen::Vector3d>> frames(vascular::beat_frames);
  for (int f = 0; f < vascular::beat_frames; ++f)
    for (int k = 0; k < places; ++k)
      frames[f].push_back(motion.centre(b.tube, b.from_m + b.length_m() * (1 + (k + 0.5) / places) / 3, f));
  const vascular::PeriodicPoints points(frames);
  Motion result;
  double period = 0;
  for (int i = 0; i < samples; ++i) {
    const double phase = (i + 0.5) / samples, dt = 1.0 / samples / vascular::phase_speed(phase, rate);
    double speed = 0;
    for (int k = 0; k < places; ++k) {
      const Eigen::Vector3d v = points.velocity(k, phase) * vascular::phase_speed(phase, rate);
      speed += per_mm * std::hypot(v.x(), v.z()) / places;
    }
    period += dt;
    result.plane_mean_mm_s += speed * dt;
    result.by_tenth_mm_s[i * 10 / samples] += speed * 10 / samples;
  }
  result.plane_mean_mm_s /= period;
  result.plane_fastest_mm_s = *std::max_element(result.by_tenth_mm_s.begin(), result.by_tenth_mm_s.end());
  const auto place = [&](int i) { return points.position(places / 2, static_cast<double>(i % samples) / samples); };
  for (int i = 0; i < samples; ++i) {
    int j = i;
    const auto fits = [&] {
      for (int k = i; k <= j; ++k)
        if ((place(j + 1) - place(k)).norm() > 1e-3) return false;
      return j - i < samples;
    };
    while (fits()) ++j;
    result.rest_ms = std::max(result.rest_ms, 60e3 / rate * (j - i) / samples);
  }
  return result;
}

data::GateResult row(const std::string& gate, double value, double reference, double tolerance, const char* unit) {
  return {gate, value, reference, tolerance, unit};
}

/// A range as its middle and half width.
data::GateResult range(const std::string& gate, double value, double low, double high, const char* unit) {
  return {gate, value, (low + high) / 2, (high - low) / 2, unit};
}

}  // namespace

std::vector<data::GateResult> anatomy_lengths(bool) {
  const vascular::Anatomy a = vascular::build_anatomy({});
  const vascular::NamedBranch &lm = branch(a, "LM"), &lad = branch(a, "LAD"), &rca = branch(a, "RCA");
  const double r4 = (origin_s(a, "PDA", "RCA") + origin_s(a, "PLV2", "RCA")) / 2;
  const vascular::Landmarks& marks = a.landmarks;
  const auto height = [&](const Eigen::Vector3d& p) { return per_mm * (p - marks.p_annulus).dot(marks.root_axis); };
  // Height of the arch: from the level at which it is 83.6 mm wide, along the centreline.
  const vascular::Tube& aorta = a.tubes[0];
  double up = 0, down = 0, top = 0;
  for (const vascular::TubeNode& node : aorta.nodes) {
    if (up == 0 && node.p.y() >= 25e-3) up = node.s_m;
    if (node.p.y() >= 25e-3) down = node.s_m, top = std::max(top, node.p.y());
  }
  const Eigen::Vector3d width = aorta.at(down).p - aorta.at(up).p;
  return {
      row("anatomy-lengths-left-main", lm.length_m() * per_mm, 10.5, 5.3, "mm"),
      row("anatomy-lengths-left-ostium-to-apex", (lad.to_m - 22e-3 - lm.from_m) * per_mm, 147, 14.5, "mm"),
      row("anatomy-lengths-circumflex", branch(a, "LCx").length_m() * per_mm, 66.3, 11.6, "mm"),
      row("anatomy-lengths-right-ostium-to-crux", (r4 - rca.from_m) * per_mm, 110, 11, "mm"),
      row("anatomy-lengths-left-ostium-height", height(marks.p_left_ostium), 14.4, 2.9, "mm"),
      row("anatomy-lengths-right-ostium-height", height(marks.p_right_ostium), 17.2, 3.3, "mm"),
      row("anatomy-lengths-arch", (down - up) * per_mm, 146.2, 7.3, "mm"),
      row("anatomy-lengths-arch-height", (top - 25e-3) * per_mm, 49.3, 2.5, "mm"),
      row("anatomy-lengths-arch-width", std::hypot(width.x(), width.z()) * per_mm, 83.6, 4.2, "mm"),
  };
}

std::vector<data::GateResult> anatomy_diameters(bool) {
  const vascular::Anatomy a = vascular::build_anatomy({}), left = build_anatomy(mean_of(vascular::Dominance::left));
  const vascular::Mesh mesh = contour(vascular::TubeUnion(a.tubes)).mesh,
                       left_mesh = vascular::contour(vascular::TubeUnion(left.tubes)).mesh;
  const vascular::BoundingVolumeHierarchy wall(mesh), left_wall(left_mesh);
  const double lm = diameter_mm(a, wall, "LM", 6), lad = diameter_mm(a, wall, "LAD", 8),
               lcx = diameter_mm(a, wall, "LCx", 5);
  return {
      row("anatomy-diameters-left-main", lm, 4.5, 0.5, "mm"),
      row("anatomy-diameters-lad-proximal", lad, 3.7, 0.4, "mm"),
      row("anatomy-diameters-lad-distal", diameter_mm(a, wall, "LAD", 95), 1.9, 0.4, "mm"),
      row("anatomy-diameters-circumflex-proximal", lcx, 3.4, 0.5, "mm"),
      row("anatomy-diameters-rca-proximal", diameter_mm(a, wall, "RCA", 10), 3.9, 0.6, "mm"),
      row("anatomy-diameters-finet-ratio", lm / (lad + lcx), 0.66, 0.08, "1"),
      row("anatomy-diameters-left-dominant-circumflex", diameter_mm(left, left_wall, "LCx", 5), 4.2, 0.6, "mm"),
      row("anatomy-diameters-left-dominant-rca", diameter_mm(left, left_wall, "RCA", 10), 2.8, 0.5, "mm"),
      row("anatomy-diameters-sinus", sinus_mm(a, wall), 29.8, 4.6, "mm"),
      row("anatomy-diameters-ascending", diameter_at_mm(a, wall, 0, {-25, 18, 15}), 30.9, 4.1, "mm"),
      row("anatomy-diameters-arch", diameter_at_mm(a, wall, 0, {-19, 50, 4}), 27.7, 3.7, "mm"),
      row("anatomy-diameters-isthmus", diameter_at_mm(a, wall, 0, {14, 50, -51}), 24.7, 4.0, "mm"),
      row("anatomy-diameters-diaphragm", diameter_at_mm(a, wall, 0, {9, -110, -55}), 24.3, 3.5, "mm"),
      row("anatomy-diameters-infrarenal", diameter_at_mm(a, wall, 0, {-1, -245, -34}), 16.5, 2.1, "mm"),
      row("anatomy-diameters-common-iliac", diameter_at_mm(a, wall, 0, {-20, -306, -47}), 9.8, 1, "mm"),
      row("anatomy-diameters-external-iliac", diameter_at_mm(a, wall, 0, {-57, -373, -26}), 7.5, 0.8, "mm"),
      row("anatomy-diameters-common-femoral", diameter_at_mm(a, wall, 0, {-81, -440, 12}), 6.9, 1.4, "mm"),
  };
}

std::vector<data::GateResult> anatomy_angles(bool) {
  const vascular::Anatomy a = vascular::build_anatomy({});
  const vascular::HeartMotion heart(a.landmarks);
  const vascular::TubeMotion motion(a, heart);
  const vascular::NamedBranch &lm = branch(a, "LM"), &lad = branch(a, "LAD"), &lcx = branch(a, "LCx");
  const int es = 9;
  const auto at = [&](const vascular::NamedBranch& b, double s, int frame) { return motion.centre(b.tube, s, frame); };
  const auto lad_lcx = [&](int f) {
    return angle_deg((at(lad, lad.from_m + 8e-3, f) - at(lad, lad.from_m + 1e-3, f)).normalized(),
                     (at(lcx, 8e-3, f) - at(lcx, 1e-3, f)).normalized());
  };
  const Eigen::Vector3d into_lm = -direction(a.tubes[lm.tube], lm.to_m, -7, -1);
  return {
      row("anatomy-angles-lad-circumflex", lad_lcx(0), 75, 23, "deg"),
      row("anatomy-angles-lad-circumflex-end-systole", lad_lcx(es), 69, 23, "deg"),
      row("anatomy-angles-left-main-circumflex", angle_deg(into_lm, direction(a.tubes[lcx.tube], 0, 1, 8)), 130, 25,
          "deg"),
      row("anatomy-angles-annulus-to-horizontal", angle_deg(a.landmarks.root_axis, Eigen::Vector3d::UnitY()), 48, 9,
          "deg"),
  };
}

std::vector<data::GateResult> anatomy_dodge(bool) {
  const vascular::Anatomy a = vascular::build_anatomy({});
  constexpr double views[8][2] = {{-30, -20}, {0, -30}, {-10, 40}, {45, 25}, {45, -30}, {-20, -25}, {40, 0}, {-30, 0}};
  std::vector<data::GateResult> results;
  for (const DodgePoint& point : dodge_points) {
    const Eigen::Vector3d off = our_place(point, a) - place(point);
    const Eigen::Matrix3d spread = covariance(point);
    double worst = 0;
    for (const auto& [lao, cran] : views) {
      const Eigen::Vector3d n = fluoro::towards_detector({.lao_rad = lao * degree, .cran_rad = cran * degree});
      const Eigen::Vector3d up = (Eigen::Vector3d::UnitY() - n.y() * n).normalized();
      for (const Eigen::Vector3d& e : {up, Eigen::Vector3d(up.cross(n))})
        worst = std::max(worst, std::fabs(off.dot(e)) / std::sqrt(e.dot(spread * e)));
    }
    results.push_back(row("anatomy-dodge-" + std::string(point.name), worst, 0, 1, "SD"));
  }
  return results;
}

std::vector<data::GateResult> anatomy_motion(bool) {
  const vascular::Anatomy a = vascular::build_anatomy({});
  const vascular::HeartMotion heart(a.landmarks);
  const vascular::TubeMotion motion(a, heart);
  const Motion rca = motion_of(a, motion, "RCA"), lcx = motion_of(a, motion, "LCx"), lm = motion_of(a, motion, "LM"),
               lad = motion_of(a, motion, "LAD");
  const auto mean = [](const Motion& m, int from, int to) {
    double sum = 0;
    for (int i = from; i < to; ++i) sum += m.by_tenth_mm_s[i % 10];
    return sum / (to - from);
  };
  // Windows of a fifth of the cycle, by their starting phase.
  double fastest = 0, slowest = 0;
  for (int i = 1; i < 10; ++i) {
    if (mean(rca, i, i + 2) > mean(rca, static_cast<int>(fastest), static_cast<int>(fastest) + 2)) fastest = i;
    if (mean(rca, i, i + 2) < mean(rca, static_cast<int>(slowest), static_cast<int>(slowest) + 2)) slowest = i;
  }
  const double in_order = (rca.plane_mean_mm_s > lcx.plane_mean_mm_s) + (lcx.plane_mean_mm_s > lm.plane_mean_mm_s) +
                          (lm.plane_mean_mm_s > lad.plane_mean_mm_s);
  return {
      range("anatomy-motion-rca-mean-speed", rca.plane_mean_mm_s, 22.4, 108.6, "mm/s"),
      range("anatomy-motion-rca-fastest-tenth", rca.plane_fastest_mm_s, 22.4, 108.6, "mm/s"),
      range("anatomy-motion-circumflex-mean-speed", lcx.plane_mean_mm_s, 22.4, 108.6, "mm/s"),
      range("anatomy-motion-left-main-mean-speed", lm.plane_mean_mm_s, 22.4, 108.6, "mm/s"),
      range("anatomy-motion-lad-mean-speed", lad.plane_mean_mm_s, 22.4, 108.6, "mm/s"),
      row("anatomy-motion-rca-lcx-lm-lad-in-order", in_order, 3, 0, "1"),
      row("anatomy-motion-fastest-fifth-from", 10 * fastest, 0, 0, "% RR"),
      row("anatomy-motion-slowest-fifth-from", 10 * slowest, 30, 0, "% RR"),
      range("anatomy-motion-rest-rca", rca.rest_ms, 66, 200, "ms"),
      range("anatomy-motion-rest-left", lcx.rest_ms, 66, 333, "ms"),
  };
}

std::vector<data::GateResult> anatomy_surface(bool quick) {
  const vascular::Patient patient = vascular::make_patient({}, {});
  double faults = 0, off_mm = 0;
  for (int f = 0; f < vascular::beat_frames; f += quick ? 8 : 1) {
    const vascular::Mesh mesh = patient.lumen.at(static_cast<double>(f) / vascular::beat_frames, 0);
    const vascular::SurfaceReport r = check_surface(mesh);
    faults += r.open_edges.count + r.branching_edges.count + r.flipped_edges.count + r.pinched_vertices.count +
              r.slivers.count + r.inverted.count + r.crossings.count + (r.components - 1);
    const vascular::BoundingVolumeHierarchy wall(mesh);
    for (const vascular::TreeBranch& b : patient.tree_frames[static_cast<std::size_t>(f)].branches)
      for (const vascular::TreeSphere& s : b.spheres)
        off_mm = std::max(off_mm, per_mm * std::fabs(wall.nearest(s.p, 0.05).distance_m - s.radius_m));
  }
  return {
      row("anatomy-surface-faults-in-all-frames", faults, 0, 0, "1"),
      range("anatomy-surface-triangles", static_cast<double>(patient.lumen.triangles.size()), 50000, 200000, "1"),
      row("anatomy-surface-tree-radii", off_mm, 0, 0.1, "mm"),
  };
}

}  // namespace ostium::app::gates
