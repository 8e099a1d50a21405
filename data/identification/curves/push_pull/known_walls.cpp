#include "data/identification/curves/push_pull/known_walls.h"

#include <algorithm>
#include <cmath>

namespace ostium::data::push_pull {

namespace {

constexpr double places_a_root = 3;  // of sqrt(R c): finer changes forces by some 0.2 % of an end's
constexpr std::size_t kept = 64;     // shapes

/// The straight part before the first bend in which the wire may touch, if the path has none as long: the walls there
/// are those of what it comes from.
double begin_of(const std::vector<Bend>& bends, double clearance_m) {
  if (bends.empty()) return 0;
  return std::min(0.0, bends.front().at_m - 1.5 * std::sqrt(48 * bends.front().radius_m * clearance_m));
}

double spacing_of(const std::vector<Bend>& bends, double clearance_m) {
  double least = 1;
  for (const Bend& b : bends) least = std::min(least, std::sqrt(b.radius_m * clearance_m));
  return least / places_a_root;
}

}  // namespace

double turned(const std::vector<Bend>& bends, double at_m) {
  double out = 0;
  for (const Bend& b : bends) out += std::clamp((at_m - b.at_m) / b.radius_m, 0.0, b.angle_rad);
  return out;
}

std::size_t KnownWalls::path(const std::vector<Bend>& bends, double clearance_m) {
  const auto same = [&](const Path& p) {
    return p.clearance_m == clearance_m &&
           std::equal(p.bends.begin(), p.bends.end(), bends.begin(), bends.end(), [](const Bend& a, const Bend& b) {
             return a.at_m == b.at_m && a.radius_m == b.radius_m && a.angle_rad == b.angle_rad;
           });
  };
  const auto found = std::find_if(paths_.begin(), paths_.end(), same);
  if (found != paths_.end()) return static_cast<std::size_t>(found - paths_.begin());
  const double spacing = spacing_of(bends, clearance_m);
  paths_.push_back({bends, clearance_m, spacing, {bends, begin_of(bends, clearance_m), spacing}, {}});
  return paths_.size() - 1;
}

KnownWalls::Shape& KnownWalls::shape(std::size_t path, double clearance_m, const std::vector<StiffPiece>& stiffness) {
  std::vector<double> key = {static_cast<double>(path), clearance_m};
  for (const StiffPiece& s : stiffness) key.push_back(s.to_m), key.push_back(s.EI_N_m2 / stiffness.back().EI_N_m2);
  const auto found = std::find_if(shapes_.rbegin(), shapes_.rend(), [&](const Shape& s) { return s.key == key; });
  if (found != shapes_.rend()) return *found;
  Shape& out = shapes_.emplace_back();
  out.all = this, out.key = key, out.path = path, out.clearance_m = clearance_m, out.stiffness = stiffness;
  if (shapes_.size() > kept) shapes_.pop_front();
  return shapes_.back();
}

const Pressing& KnownWalls::Shape::at(double inserted_m) {
  const auto known = pressing.find(inserted_m);
  if (known != pressing.end()) return known->second;
  Path& p = all->paths_[path];
  // Of the shape before, or else of the nearest insertion.
  const auto next = p.touches.lower_bound(inserted_m);
  std::vector<Touch> touches;
  if (next != p.touches.end() && next->first == inserted_m)
    touches = next->second;
  else if (next != p.touches.begin())
    touches = std::prev(next)->second;
  Pressing& out = pressing[inserted_m];
  for (const WallForce& f : p.beam.forces(inserted_m, clearance_m, stiffness, touches))
    out.places.push_back({turned(p.bends, f.at_m), f.force_N / stiffness.back().EI_N_m2});
  out.turned_rad = turned(p.bends, inserted_m);
  p.touches[inserted_m] = touches;
  return out;
}

}  // namespace ostium::data::push_pull
