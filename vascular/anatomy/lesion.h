#pragma once
/// Narrowings: a length of a branch whose lumen is smaller than it was, on all sides or from one.
#include <string>
#include <vector>

#include "vascular/anatomy/anatomy.h"

namespace ostium::vascular {

struct Lesion {
  std::string branch;      ///< name, as the anatomy has it
  double from_m = 0;       ///< proximal end, from the branch's origin
  double length_m = 0;     ///< > 0
  double stenosis = 0;     ///< of the diameter, in (0, 0.95]: what is missing where it is narrowest
  bool eccentric = false;  ///< the plaque is on one side only, the opposite wall stays
  double side_rad = 0;     ///< where an eccentric plaque is: 0 towards the heart, turning towards the branch's right
  bool calcified = false;  ///< for X-ray and balloon; no geometry
};

/// Kinds of lesion after ACC/AHA (Ryan et al., Circulation 1988;78:486): A short and concentric, B tubular or
/// eccentric, C longer than 20 mm. Everything but the place is set.
enum class LesionType { A, B, C };
Lesion typical(LesionType type, const std::string& branch, double from_m);
LesionType type_of(const Lesion& lesion);

/// Throws std::invalid_argument saying what exists: unknown branch, a lesion that does not fit it, a stenosis outside.
void check(const Anatomy& anatomy, const Lesion& lesion);

/// What lesions do to a tube's section.
struct Narrowing {
  double scale = 1;                                 ///< of the radius
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< of the centre
  bool none() const { return scale == 1; }
};
Narrowing narrowing_at(const Anatomy& anatomy, const std::vector<Lesion>& lesions, int tube, double s_m);

/// Where the wall of the healthy lumen at `p` is with the lesions.
Eigen::Vector3d diseased(const Anatomy& anatomy, const std::vector<Lesion>& lesions, const Eigen::Vector3d& p,
                         const std::vector<TubeShare>& shares);

}  // namespace ostium::vascular
