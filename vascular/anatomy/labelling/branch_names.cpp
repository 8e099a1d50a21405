#include "vascular/anatomy/labelling/branch_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

namespace {

using units::mm;

int tube_named(const Anatomy& anatomy, const std::string& name) {
  for (std::size_t t = 0; t < anatomy.tubes.size(); ++t)
    if (anatomy.tubes[t].name == name) return static_cast<int>(t);
  return -1;
}

/// Names the branches between root and diaphragm, from right to left in the order of their origins.
void name_arch(Anatomy& anatomy, std::vector<std::string>& notes) {
  std::vector<Tube>& tubes = anatomy.tubes;
  const Tube& aorta = tubes[0];
  double top = 0;
  for (const TubeNode& node : aorta.nodes)
    if (node.s_m < 0.25 && node.p.y() > aorta.at(top).p.y()) top = node.s_m;
  std::vector<std::pair<double, int>> leaving;
  for (int t = 1; t < static_cast<int>(tubes.size()); ++t) {
    if (tubes[t].parent != 0 || !tubes[t].name.empty()) continue;
    const double s = nearest_s(aorta, tubes[t].nodes.front().p);
    if (std::fabs(s - top) < 60 * mm && tubes[t].nodes.back().p.y() > aorta.at(s).p.y()) leaving.push_back({s, t});
  }
  std::sort(leaving.begin(), leaving.end());
  // The arch's branches are held in place by the neck.
  anatomy.ascending_m = std::clamp(0.8 * (leaving.empty() ? top : leaving.front().first), 30 * mm, 75 * mm);
  const std::vector<const char*> names =
      leaving.size() == 3   ? std::vector<const char*>{"brachiocephalic", "left carotid", "left subclavian"}
      : leaving.size() == 2 ? std::vector<const char*>{"brachiocephalic", "left subclavian"}
                            : std::vector<const char*>{};
  for (std::size_t i = 0; i < names.size(); ++i) tubes[leaving[i].second].name = names[i];
  notes.push_back(fmt::format("arch: its top is {:.0f} mm from the root; {} vessels leave it{}", top / mm,
                              leaving.size(), names.empty() ? ", which stay numbers" : ""));
}

/// Names the aorta and the iliac arteries it divides into.
void name_aorta(const std::vector<double>& leaves_m, Anatomy& anatomy) {
  std::vector<Tube>& tubes = anatomy.tubes;
  const Tube& aorta = tubes[0];
  int other = -1;
  double at = 0;
  for (int t = 1; t < static_cast<int>(tubes.size()); ++t) {
    if (tubes[t].parent != 0 || !tubes[t].name.empty() || tubes[t].length_m() < 40 * mm) continue;
    const double s = nearest_s(aorta, tubes[t].nodes.front().p);
    const double after = aorta.at(s + 25 * mm).radius_m, before = aorta.at(s - 15 * mm).radius_m;
    const double ratio = tubes[t].at(leaves_m[t] + 15 * mm).radius_m / after;
    if (s > 0.2 && after < 0.8 * before && ratio > 0.55 && ratio < 1.8 && s > at) at = s, other = t;
  }
  if (other < 0) {
    anatomy.branches.push_back({"aorta", 0, 0, aorta.length_m()});
    return;
  }
  const bool own_is_right = aorta.nodes.back().p.x() < tubes[other].nodes.back().p.x();
  tubes[other].name = own_is_right ? "left iliac" : "right iliac";
  anatomy.branches.push_back({"aorta", 0, 0, at});
  anatomy.branches.push_back({own_is_right ? "right iliac" : "left iliac", 0, at, aorta.length_m()});
}

void rename(const std::map<std::string, std::string>& names, Anatomy& anatomy) {
  std::string all;
  for (const NamedBranch& branch : anatomy.branches) all += (all.empty() ? "" : ", ") + branch.name;
  for (const auto& [found, wanted] : names)
    if (std::ranges::count(anatomy.branches, found, &NamedBranch::name) == 0)
      throw MeshError(fmt::format("there is no branch \"{}\" to be called {}; found: {}", found, wanted, all));
  for (NamedBranch& branch : anatomy.branches)  // at once, so that names may be exchanged
    if (const auto wanted = names.find(branch.name); wanted != names.end()) branch.name = wanted->second;
  for (const auto& [found, wanted] : names)
    if (std::ranges::count(anatomy.branches, wanted, &NamedBranch::name) > 1)
      throw MeshError(
          fmt::format("more than one branch would be called {}; expected a name for each; found: {}", wanted, all));
}

}  // namespace

void name_branches(const std::vector<double>& leaves_m, const std::map<std::string, std::string>& names,
                   Anatomy& anatomy, std::vector<std::string>& notes) {
  std::vector<Tube>& tubes = anatomy.tubes;
  if (anatomy.aorta) {
    name_arch(anatomy, notes);
    name_aorta(leaves_m, anatomy);
  }
  const bool unknown = std::ranges::all_of(tubes, [](const Tube& tube) { return tube.name.empty(); });
  int number = 0;
  const int lad = tube_named(anatomy, "LAD"), lcx = tube_named(anatomy, "LCx");
  for (int t = anatomy.aorta ? 1 : 0; t < static_cast<int>(tubes.size()); ++t) {
    double from = leaves_m[t];
    if (t == lad && lcx >= 0) {
      const double parting = std::clamp(nearest_s(tubes[t], tubes[lcx].nodes.front().p), from, tubes[t].length_m());
      anatomy.branches.push_back({"LM", t, from, parting});
      from = parting;
    }
    if (tubes[t].name.empty()) tubes[t].name = (unknown ? "vessel " : "") + std::to_string(++number);
    anatomy.branches.push_back({tubes[t].name, t, from, tubes[t].length_m()});
  }
  rename(names, anatomy);
}

}  // namespace ostium::vascular
