#include "vascular/anatomy/editing/course_check.h"

#include <cmath>
#include <optional>

namespace ostium::vascular {

namespace {

constexpr double least_m = 1e-4;
constexpr double on_wall_m = 1e-5;  // the last sphere lies on a lid
using Kind = CourseFault::Kind;

struct SphereFinding {
  Kind kind;
  double by_m;
};

bool in_parent(const Anatomy& anatomy, const Tube& tube, const TubeNode& node) {
  if (tube.parent < 0) return false;
  const Tube& parent = anatomy.tubes[static_cast<std::size_t>(tube.parent)];
  const TubeNode at = parent.at(nearest_s(parent, node.p));
  return (at.p - node.p).norm() < at.radius_m + node.radius_m;
}

std::optional<SphereFinding> finding_at(const Anatomy& anatomy, const Tube& tube, const TubeNode& node,
                                        const LumenGauge& lumen) {
  const double clearance_m = lumen.clearance_m(node.p), allowed_m = least_m + course_tolerance * node.radius_m;
  if (clearance_m < -on_wall_m) return SphereFinding{Kind::outside, -clearance_m};
  const double from_end_m = std::min(node.s_m, tube.length_m() - node.s_m);
  if (from_end_m < node.radius_m || in_parent(anatomy, tube, node)) return {};
  if (node.radius_m > clearance_m + allowed_m) return SphereFinding{Kind::too_wide, node.radius_m - clearance_m};
  if (clearance_m > node.radius_m + allowed_m) return SphereFinding{Kind::too_thin, clearance_m - node.radius_m};
  return {};
}

/// A branch's first sphere touches its parent's, or nothing leads from one to the other.
std::optional<CourseFault> apart(const Anatomy& anatomy, int t) {
  const Tube& tube = anatomy.tubes[static_cast<std::size_t>(t)];
  if (tube.parent < 0) return {};
  const Tube& parent = anatomy.tubes[static_cast<std::size_t>(tube.parent)];
  const TubeNode& first = tube.nodes.front();
  const TubeNode at = parent.at(nearest_s(parent, first.p));
  const double gap_m = (at.p - first.p).norm() - at.radius_m - first.radius_m;
  if (gap_m <= 0) return {};
  return CourseFault{.kind = Kind::apart, .tube = t, .worst_m = gap_m};
}

}  // namespace

std::vector<CourseFault> check_courses(const Anatomy& anatomy, const LumenGauge& lumen) {
  std::vector<CourseFault> faults;
  for (int t = 0; t < static_cast<int>(anatomy.tubes.size()); ++t) {
    const Tube& tube = anatomy.tubes[static_cast<std::size_t>(t)];
    if (!tube.leaves_parent) continue;
    if (const auto fault = apart(anatomy, t)) faults.push_back(*fault);
    std::optional<Kind> last;
    for (const TubeNode& node : tube.nodes) {
      const auto found = finding_at(anatomy, tube, node, lumen);
      if (found && found->kind != last)
        faults.push_back({.kind = found->kind, .tube = t, .from_m = node.s_m, .to_m = node.s_m});
      if (found) {
        CourseFault& fault = faults.back();
        fault.to_m = node.s_m;
        if (found->by_m > fault.worst_m) fault.worst_m = found->by_m, fault.worst_at_m = node.s_m;
      }
      last = found ? std::optional(found->kind) : std::nullopt;
    }
  }
  return faults;
}

}  // namespace ostium::vascular
