#include "vascular/geometry/repair/units.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "vascular/geometry/repair/calibre.h"
#include "vascular/geometry/repair/sheets.h"

namespace ostium::vascular {

namespace {

struct Range {
  double least, most;
  bool holds(double x) const { return x >= least && x <= most; }
};

struct VesselKind {
  const char* name;
  Range extent_mm, wide_mm;
  double most_narrow = 1;  // largest share of the narrow calibre in the wide one: a long aorta has branches
};
/// Estimates, wide enough for parts, children and aneurysms. Calibres of the aorta: Hager 2002, infrarenal and iliac:
/// CT of 1,340 people (anatomy/parameters.h), with their widest members.
constexpr VesselKind kinds[] = {{"a coronary artery or a tree of them", {20, 180}, {1.5, 7}},
                                {"an artery of the brain, or a side branch", {12, 180}, {0.8, 5}},
                                {"a carotid, renal or other artery of an organ", {25, 250}, {3.5, 10}},
                                {"an artery of the pelvis, a leg, an arm or the neck", {40, 500}, {4, 14}},
                                {"a part of the aorta", {50, 550}, {14, 45}},
                                {"an aneurysm of the aorta", {60, 350}, {30, 80}},
                                {"an aorta with its branches", {250, 900}, {10, 45}, 0.6}};
constexpr double least_slender = 2;  // extent over calibre; arches and loops have less than straight vessels

}  // namespace

VesselSize vessel_size(const Mesh& given) {
  Mesh mesh = given;
  Sheets sheets = sheets_of(mesh);
  orient(mesh, sheets);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  VesselSize size;
  size.extent = box.sizes().maxCoeff();
  if (!(size.extent > 0)) return size;
  // In metres as if it were 100 mm long, since calibres begin a fixed distance inside the wall.
  const double scale = 0.1 / size.extent;
  for (Eigen::Vector3d& p : mesh.vertices) p *= scale;
  const BoundingVolumeHierarchy tree(mesh);
  const int stride = 1 + static_cast<int>(mesh.triangles.size() / 4'000);
  const std::vector<double> all = calibres(mesh, tree, stride, 1), areas = areas_m2(mesh, stride);
  size.wide = percentile(all, areas, 0.75) / scale;
  size.narrow = percentile(all, areas, 0.1) / scale;
  return size;
}

std::vector<UnitReading> unit_readings(const VesselSize& size) {
  std::vector<UnitReading> readings;
  if (size.wide <= 0 || size.extent < least_slender * size.wide) return readings;
  for (LengthUnit unit : length_units) {
    const double mm = 1e3 * metres(unit);
    const auto* kind = std::ranges::find_if(kinds, [&](const VesselKind& k) {
      return k.extent_mm.holds(mm * size.extent) && k.wide_mm.holds(mm * size.wide) &&
             size.narrow <= k.most_narrow * size.wide;
    });
    if (kind != std::end(kinds)) readings.push_back({unit, kind->name});
  }
  return readings;
}

}  // namespace ostium::vascular
