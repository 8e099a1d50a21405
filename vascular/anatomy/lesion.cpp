#include "vascular/anatomy/lesion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/random.h"
#include "core/base/units.h"

namespace ostium::vascular {

namespace {

using units::mm;
constexpr double rounding_m = 1e-9;  // of lengths given in mm
constexpr double shoulder = 0.3;     // share of the length over which the narrowing sets in, at either end

/// 0 at the ends, 1 between the shoulders, with a continuous slope.
double depth_at(const Lesion& lesion, double from_branch_m) {
  const double x = (from_branch_m - lesion.from_m) / lesion.length_m, end = std::min(x, 1 - x);
  if (end <= 0) return 0;
  return end >= shoulder ? 1 : (1 - std::cos(units::pi * end / shoulder)) / 2;
}

constexpr double calcified_from = 2 * units::pi / 3;

std::string names(const Anatomy& anatomy) {
  std::string all;
  for (const NamedBranch& branch : anatomy.branches) all += (all.empty() ? "" : ", ") + branch.name;
  return all;
}

}  // namespace

Composition typical_composition(bool calcified) {
  if (!calcified) return {};
  return {.calcium_arc_rad = 1.25 * units::pi, .calcium_thickness_m = 0.7 * mm, .calcium_length_share = 0.7};
}

Composition draw_composition(bool calcified, std::uint64_t seed, std::uint64_t lesion) {
  constexpr std::uint64_t stream = 0x706c61717565;
  const auto u = [&](std::uint64_t number) { return core::uniform(seed, stream + lesion, number); };
  const double normal = std::sqrt(-2 * std::log(1 - u(0))) * std::cos(2 * units::pi * u(1)),
               arc =
                   calcified ? calcified_from + u(2) * 7 * units::pi / 6 : calcified_from * std::max(0.0, 2 * u(2) - 1);
  return {std::exp(0.3 * normal), arc, (0.3 + 0.8 * u(3)) * mm, 0.4 + 0.6 * u(4)};
}

bool Composition::calcified() const { return calcium_arc_rad >= calcified_from; }

Lesion typical(LesionType type, const std::string& branch, double from_m) {
  Lesion lesion{.branch = branch, .from_m = from_m};
  switch (type) {
    case LesionType::A:
      lesion.length_m = 8 * mm, lesion.stenosis = 0.70;
      break;
    case LesionType::B:
      lesion.length_m = 15 * mm, lesion.stenosis = 0.75, lesion.eccentric = true;
      break;
    case LesionType::C:
      lesion.length_m = 28 * mm, lesion.stenosis = 0.80, lesion.made_of = typical_composition(true);
      break;
  }
  return lesion;
}

LesionType type_of(const Lesion& lesion) {
  if (lesion.length_m > 20 * mm) return LesionType::C;
  return lesion.length_m >= 10 * mm || lesion.eccentric || lesion.made_of.calcified() ? LesionType::B : LesionType::A;
}

void place(const Anatomy& anatomy, Lesion& lesion) {
  const NamedBranch *branch = find_branch(anatomy, lesion.branch), *side = find_branch(anatomy, lesion.at_branch);
  if (lesion.at_branch.empty() || !branch) return;
  const std::size_t tube = side ? static_cast<std::size_t>(side->tube) : 0;
  if (!side || anatomy.tubes[tube].parent != branch->tube)
    throw std::invalid_argument(
        fmt::format("at_branch is \"{}\"; expected a branch that leaves {}", lesion.at_branch, lesion.branch));
  const double leaves_m =
      nearest_s(anatomy.tubes[static_cast<std::size_t>(branch->tube)], anatomy.tubes[tube].nodes.front().p) -
      branch->from_m;
  lesion.from_m = leaves_m + lesion.from_at_m;
}

void check(const Anatomy& anatomy, const Lesion& lesion) {
  const NamedBranch* branch = find_branch(anatomy, lesion.branch);
  if (!branch)
    throw std::invalid_argument(
        fmt::format("there is no branch \"{}\"; expected one of {}", lesion.branch, names(anatomy)));
  if (!(lesion.stenosis > 0 && lesion.stenosis <= 0.95))
    throw std::invalid_argument(fmt::format("a stenosis of {:g} % of the diameter; expected more than 0 and at most 95",
                                            100 * lesion.stenosis));
  if (!(lesion.length_m >= shortest_lesion_m - rounding_m))
    throw std::invalid_argument(
        fmt::format("a lesion {:g} mm long; expected at least {:g} mm", lesion.length_m / mm, shortest_lesion_m / mm));
  if (!(lesion.from_m >= 0 && lesion.from_m + lesion.length_m <= branch->length_m()))
    throw std::invalid_argument(fmt::format(
        "a lesion from {:g} to {:g} mm of {}; expected it within the branch's {:.1f} mm", lesion.from_m / mm,
        (lesion.from_m + lesion.length_m) / mm, lesion.branch, branch->length_m() / mm));
}

void check_apart(const std::vector<Lesion>& lesions) {
  for (std::size_t i = 0; i < lesions.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Lesion &a = lesions[j], &b = lesions[i];
      if (a.branch != b.branch || a.from_m + a.length_m <= b.from_m + rounding_m ||
          b.from_m + b.length_m <= a.from_m + rounding_m)
        continue;
      throw std::invalid_argument(fmt::format(
          "lesions {} and {} of {} share a stretch ({:g} to {:g} mm and {:g} to {:g} mm); expected one, or both apart",
          j + 1, i + 1, a.branch, a.from_m / mm, (a.from_m + a.length_m) / mm, b.from_m / mm,
          (b.from_m + b.length_m) / mm));
    }
}

Narrowing narrowing_at(const Anatomy& anatomy, const std::vector<Lesion>& lesions, int tube, double s_m) {
  Narrowing total;
  for (const Lesion& lesion : lesions) {
    const NamedBranch& branch = *find_branch(anatomy, lesion.branch);
    if (branch.tube != tube) continue;
    const double lost = lesion.stenosis * depth_at(lesion, s_m - branch.from_m);
    if (lost == 0) continue;
    const TubeNode node = anatomy.tubes[tube].at(s_m);
    if (lesion.eccentric) {
      const Landmarks& marks = anatomy.landmarks;
      const Eigen::Vector3d along = anatomy.tubes[tube].tangent(s_m);
      Eigen::Vector3d to_heart = (marks.p_lv_base + marks.p_lv_apex) / 2 - node.p;
      to_heart = (to_heart - to_heart.dot(along) * along).normalized();
      const Eigen::Vector3d plaque =
          std::cos(lesion.side_rad) * to_heart + std::sin(lesion.side_rad) * to_heart.cross(along);
      total.shift -= total.scale * lost * node.radius_m * plaque;
    }
    total.scale *= 1 - lost;
  }
  return total;
}

Eigen::Vector3d diseased(const Anatomy& anatomy, const std::vector<Lesion>& lesions, const Eigen::Vector3d& p,
                         const std::vector<TubeShare>& shares) {
  Eigen::Vector3d moved = p;
  for (const TubeShare& share : shares) {
    const Narrowing narrowing = narrowing_at(anatomy, lesions, share.tube, share.s_m);
    if (narrowing.none()) continue;
    const Eigen::Vector3d arm = p - anatomy.tubes[share.tube].at(share.s_m).p;
    moved += share.weight * (narrowing.shift + (narrowing.scale - 1) * arm);
  }
  return moved;
}

}  // namespace ostium::vascular
