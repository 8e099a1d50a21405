#include "vascular/geometry/repair/units.h"

#include <Eigen/Geometry>
#include <cmath>

#include "vascular/geometry/repair/calibre.h"
#include "vascular/geometry/repair/sheets.h"

namespace ostium::vascular {

namespace {

struct Prototype {
  double extent_mm, calibre_mm;
};
constexpr Prototype prototypes[] = {{110, 4}, {150, 30}, {250, 8}, {420, 24}, {600, 22}, {650, 30}};
constexpr LengthUnit units[] = {LengthUnit::millimetre, LengthUnit::centimetre, LengthUnit::metre, LengthUnit::inch};
constexpr double farthest = 1.2;  // largest accepted sum of the two logarithms
constexpr double clearly = 0.5;   // required distance to the second best

}  // namespace

UnitGuess guess_unit(const Mesh& raw) {
  Mesh mesh = raw;
  Sheets sheets = sheets_of(mesh);
  orient(mesh, sheets);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  const double extent = box.sizes().maxCoeff();
  const BoundingVolumeHierarchy tree(mesh);
  const int stride = 1 + static_cast<int>(mesh.triangles.size() / 4'000);
  const double calibre = percentile(calibres(mesh, tree, stride, extent), areas_m2(mesh, stride), 0.9);
  UnitGuess guess;
  double best = 1e9, second = 1e9;
  for (LengthUnit unit : units) {
    double off = 1e9;
    for (const Prototype& p : prototypes)
      off = std::min(off, std::fabs(std::log(metres(unit) * extent / (1e-3 * p.extent_mm))) +
                              std::fabs(std::log(metres(unit) * std::max(calibre, 1e-9) / (1e-3 * p.calibre_mm))));
    if (off < best) {
      second = best;
      best = off;
      guess.unit = unit;
    } else {
      second = std::min(second, off);
    }
  }
  guess.extent_m = metres(guess.unit) * extent;
  guess.calibre_m = metres(guess.unit) * calibre;
  guess.vessel = best < farthest;
  guess.certain = guess.vessel && second > best + clearly;
  return guess;
}

std::string name_of(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::millimetre:
      return "mm";
    case LengthUnit::centimetre:
      return "cm";
    case LengthUnit::inch:
      return "in";
    case LengthUnit::metre:
      break;
  }
  return "m";
}

LengthUnit unit_named(const std::string& name) {
  for (LengthUnit unit : units)
    if (name_of(unit) == name) return unit;
  throw MeshError("there is no unit \"" + name + "\"; expected mm, cm, m or in");
}

}  // namespace ostium::vascular
