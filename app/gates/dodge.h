#pragma once
/// Coronary points of right-dominant men: Dodge JT et al., Circulation 1988;78:1167, tables 3 to 5. Distance r from the
/// ostium in cm; theta about the head's axis, 0 in front, positive to the patient's left; phi above the horizontal;
/// their standard deviations. "mid" is half-way along the segment or visible branch.
#include <Eigen/Geometry>

#include "vascular/anatomy/anatomy.h"

namespace ostium::app::gates {

struct DodgePoint {
  const char* name;
  bool right;  ///< measured from the right ostium
  double r_cm, theta_deg, phi_deg, r_sd_cm, theta_sd_deg, phi_sd_deg;
};

inline constexpr DodgePoint dodge_points[] = {
    {"L1-mid", false, 2.3, 63, -5, 0.8, 10, 11},  {"L2-mid", false, 5.3, 44, -12, 0.8, 7, 9},
    {"L3-mid", false, 10.1, 30, -32, 0.9, 8, 7},  {"L4-proximal", false, 12.2, 32, -46, 1.0, 9, 7},
    {"D1-mid", false, 6.2, 61, -23, 1.0, 9, 11},  {"D2-mid", false, 7.7, 49, -24, 0.7, 10, 8},
    {"S1-mid", false, 4.3, 35, -31, 1.1, 12, 10}, {"C1-mid", false, 1.8, 94, -24, 0.8, 17, 12},
    {"C2-mid", false, 3.1, 116, -37, 0.9, 18, 9}, {"C3-mid", false, 4.8, 135, -51, 1.0, 21, 8},
    {"M1-mid", false, 5.6, 91, -38, 1.4, 15, 9},  {"M2-mid", false, 6.0, 109, -51, 0.8, 20, 8},
    {"R1-mid", true, 1.7, -68, -24, 0.4, 14, 11}, {"R2-mid", true, 4.6, -72, -48, 0.7, 11, 8},
    {"R3-mid", true, 6.4, -91, -69, 1.1, 64, 5},  {"R4-mid", true, 6.2, 180, -66, 0.8, 19, 8},
    {"RD-mid", true, 7.6, 80, -76, 1.1, 60, 8},   {"RP-mid", true, 8.0, 145, -56, 0.8, 21, 9},
};

/// Position of the point relative to its ostium (metres), and its covariance.
Eigen::Vector3d place(const DodgePoint& point);
Eigen::Matrix3d covariance(const DodgePoint& point);

/// The same point of our anatomy, from the same ostium: segments end at the origins of side branches, as Dodge's do.
Eigen::Vector3d our_place(const DodgePoint& point, const vascular::Anatomy& anatomy);

}  // namespace ostium::app::gates
