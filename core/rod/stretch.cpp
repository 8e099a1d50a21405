#include "core/rod/stretch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/math/rotation.h"
#include "core/rod/inertia.h"
#include "core/solver/node_spring.h"

namespace ostium::core {

namespace {

double from_tip_m(const Rod& rod, int i, int end) {
  return rod.node_from_tip_m[static_cast<std::size_t>(rod.elements - (end - 1 - i))];
}

int nearest_to(const Rod& rod, double at_m, int begin, int end) {
  int nearest = end - 1;
  for (int i = begin; i < end; ++i)
    if (std::fabs(from_tip_m(rod, i, end) - at_m) < std::fabs(from_tip_m(rod, nearest, end) - at_m)) nearest = i;
  return nearest;
}

}  // namespace

void add_stretch_load(const Rod& rod, const StretchLoad& load, int begin, int end, RodScratch& scratch) {
  if (load.force_W_N.isZero()) return;
  int first = end, last = begin - 1;
  for (int i = begin; i < end; ++i) {
    const double at_m = from_tip_m(rod, i, end);
    if (at_m >= load.from_tip_m && at_m <= load.to_tip_m) first = std::min(first, i), last = i;
  }
  if (last < first) first = last = nearest_to(rod, (load.from_tip_m + load.to_tip_m) / 2, begin, end);
  for (int i = first; i <= last; ++i) add_load(i, load.force_W_N / (last - first + 1), scratch);
}

void tie_to_tether(const Rod& rod, const Tether& tether, int begin, int end, const RodState& own, RodScratch& scratch) {
  if (!(tether.along_N_m > 0 || tether.across_N_m > 0)) return;
  const int i = nearest_to(rod, tether.from_tip_m, begin, end);
  const double beyond_m = tether.from_tip_m - from_tip_m(rod, i, end);
  if (std::fabs(beyond_m) > scratch.inside.joint_length.at(0)[i]) return;
  // The node lies beyond the tether's position, along the element between them.
  const int between = std::clamp(beyond_m > 0 ? i - 1 : i, begin, std::max(begin, end - 2));
  const V3<double> beyond = beyond_m * director3(load4<double>(own.orientation, between)),
                   place = from_eigen(tether.point_W) + beyond;
  S3<double> P = load6<double>(scratch.chain.compliance, i);
  V3<double> target = load3<double>(scratch.target, i);
  const auto tie_along = [&](const Eigen::Vector3d& n_W, double stiffness_N_m) {
    const V3<double> n = from_eigen(n_W);
    if (stiffness_N_m > 0) tie(n, dot(n, place), 1 / stiffness_N_m, P, target);
  };
  const Eigen::Vector3d across_W = tether.along_W.unitOrthogonal();
  tie_along(tether.along_W, tether.along_N_m);
  tie_along(across_W, tether.across_N_m), tie_along(tether.along_W.cross(across_W), tether.across_N_m);
  store6(scratch.chain.compliance, i, P);
  store3(scratch.target, i, target);
}

}  // namespace ostium::core
