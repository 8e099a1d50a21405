#pragma once
/// Parameters that differ between people. Defaults are the published means; standard deviations are given beside them.
#include <Eigen/Core>
#include <cstdint>

namespace ostium::vascular {

enum class Dominance { right, left, balanced };
enum class Access { femoral, radial };

struct AnatomyParameters {
  Dominance dominance = Dominance::right;  ///< 85, 8, 7 % of people
  Access access = Access::femoral;
  int diagonals = 2;   ///< 1 to 3; 14, 62, 24 % of people
  bool ramus = false;  ///< an artery between LAD and circumflex: 15 to 32 %

  // The heart about the aortic root. Dodge 1988: radial SD 8 %, angular SD 7 to 10 degrees at distal points.
  double heart_scale = 1;                                    ///< [0.8, 1.2]
  Eigen::Vector3d heart_turn_rad = Eigen::Vector3d::Zero();  ///< about x, y, z; each within 0.35
  double course_wander_m = 0;                                ///< SD of the other scatter along a branch; [0, 3e-3]
  std::uint64_t wander_seed = 0;

  // Coronary diameters in mm: Dodge 1992; middle and distal: CT. Women's are 9 % smaller.
  double left_main_mm = 4.5;     ///< SD 0.5
  double lad_proximal_mm = 3.7;  ///< SD 0.4
  double lad_distal_mm = 1.9;    ///< SD 0.4
  double lcx_proximal_mm = 3.4;  ///< SD 0.5; left-dominant 4.2, SD 0.6
  double rca_proximal_mm = 3.9;  ///< SD 0.6; left-dominant 2.8, SD 0.5
  double side_branch_scale = 1;  ///< of all other coronary diameters; [0.6, 1.4]

  // Aorta in mm: Hager 2002; infrarenal and common iliac: CT of 1340 people; arch: CT of 344 men.
  double sinus_mm = 29.8;       ///< SD 4.6
  double ascending_mm = 30.9;   ///< SD 4.1
  double arch_mm = 27.7;        ///< SD 3.7
  double isthmus_mm = 24.7;     ///< SD 4.0
  double diaphragm_mm = 24.3;   ///< SD 3.5
  double infrarenal_mm = 16.5;  ///< SD 2.1
  double common_iliac_mm = 9.8;
  double external_iliac_mm = 7.5;
  double femoral_mm = 6.9;  ///< SD 1.4
  double arch_height_mm = 49.3;
  double arch_width_mm = 83.6;
};

/// Parameters of a person, drawn with the published standard deviations and limited to two of them. Seed 0 is the mean.
/// Dominance and access are those of `base`.
AnatomyParameters person(std::uint64_t seed, const AnatomyParameters& base);

/// The mean person of a dominance, with the diameters published for it.
AnatomyParameters mean_of(Dominance dominance, Access access = Access::femoral);

}  // namespace ostium::vascular
