#pragma once
/// Lesions: a length of a branch whose lumen is narrowed, all round or from one side.
#include <cstdint>
#include <string>
#include <vector>

#include "vascular/anatomy/anatomy.h"

namespace ostium::vascular {

/// What a plaque is made of, as a balloon feels it; no effect on geometry.
struct Composition {
  double hardness = 1;  ///< > 0, of its soft part, as a multiple of the typical plaque's
  double calcium_arc_rad = 0, calcium_thickness_m = 0;
  double calcium_length_share = 1;  ///< of the lesion's length, about its middle
  /// More calcium than an arc of 120 degrees.
  bool calcified() const;
};
/// A calcified plaque's calcium (arc 225 degrees, 0.7 mm thick, over 0.7 of the length), or none.
Composition typical_composition(bool calcified);
/// One person's: hardness log-normal about the typical one, with a standard deviation of its logarithm of 0.3; arc 120
/// to 330 degrees where calcified, else none in half the persons and up to 120 degrees; thickness 0.3 to 1.1 mm over
/// 0.4 to 1 of the length. Arcs, thickness and length as intravascular pictures find them [from memory]; the spread of
/// the hardness is fitted (treatment/plaque.h).
Composition draw_composition(bool calcified, std::uint64_t seed, std::uint64_t lesion);

struct Lesion {
  std::string branch;      ///< name in the anatomy
  double from_m = 0;       ///< proximal end, from the branch's origin
  double length_m = 0;     ///< at least shortest_lesion_m
  double stenosis = 0;     ///< of the diameter, in (0, 0.95]: the missing share at the narrowest point
  bool eccentric = false;  ///< plaque on one side only; the opposite wall is unchanged
  double side_rad = 0;     ///< position of an eccentric plaque: 0 towards the heart, turning towards the branch's right
  Composition made_of = {};
  std::string at_branch = {};  ///< of the branch's own branches: `from_m` follows it in every person; empty: none
  double from_at_m = 0;        ///< proximal end from where that leaves, negative before it
};

/// Lesion types after ACC/AHA (Ryan et al., Circulation 1988;78:486): A short and concentric, B tubular or eccentric, C
/// longer than 20 mm. Sets everything except the location.
enum class LesionType { A, B, C };
Lesion typical(LesionType type, const std::string& branch, double from_m);
LesionType type_of(const Lesion& lesion);

/// A shorter one would lie between the cells (0.7 mm) and triangles that carry an artery, and show less than it says.
inline constexpr double shortest_lesion_m = 3e-3;

/// Sets `from_m` of a lesion that follows a branch of its branch. Throws std::invalid_argument if that does not leave
/// it.
void place(const Anatomy& anatomy, Lesion& lesion);

/// Throws std::invalid_argument listing valid values: unknown branch, a lesion that does not fit it, a stenosis out of
/// range.
void check(const Anatomy& anatomy, const Lesion& lesion);
/// Throws std::invalid_argument if two share a stretch of a branch, where both would narrow what the other leaves.
void check_apart(const std::vector<Lesion>& lesions);

/// Effect of lesions on a tube's cross-section.
struct Narrowing {
  double scale = 1;                                 ///< of the radius
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< of the centre
  bool none() const { return scale == 1; }
};
Narrowing narrowing_at(const Anatomy& anatomy, const std::vector<Lesion>& lesions, int tube, double s_m);

/// Position on the diseased wall of the point `p` of the healthy wall.
Eigen::Vector3d diseased(const Anatomy& anatomy, const std::vector<Lesion>& lesions, const Eigen::Vector3d& p,
                         const std::vector<TubeShare>& shares);

}  // namespace ostium::vascular
