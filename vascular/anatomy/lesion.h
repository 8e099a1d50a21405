#pragma once
/// Lesions: a length of a branch whose lumen is narrowed, all round or from one side.
#include <string>
#include <vector>

#include "vascular/anatomy/anatomy.h"

namespace ostium::vascular {

struct Lesion {
  std::string branch;      ///< name in the anatomy
  double from_m = 0;       ///< proximal end, from the branch's origin
  double length_m = 0;     ///< > 0
  double stenosis = 0;     ///< of the diameter, in (0, 0.95]: the missing share at the narrowest point
  bool eccentric = false;  ///< plaque on one side only; the opposite wall is unchanged
  double side_rad = 0;     ///< position of an eccentric plaque: 0 towards the heart, turning towards the branch's right
  bool calcified = false;  ///< for X-ray and balloon; no effect on geometry
};

/// Lesion types after ACC/AHA (Ryan et al., Circulation 1988;78:486): A short and concentric, B tubular or eccentric, C
/// longer than 20 mm. Sets everything except the location.
enum class LesionType { A, B, C };
Lesion typical(LesionType type, const std::string& branch, double from_m);
LesionType type_of(const Lesion& lesion);

/// Throws std::invalid_argument listing valid values: unknown branch, a lesion that does not fit it, a stenosis out of
/// range.
void check(const Anatomy& anatomy, const Lesion& lesion);

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
