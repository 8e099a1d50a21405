#pragma once
/// Arteries and veins of the lungs, which a chest X-ray shows as branching lines and mottle.
///
/// Ends are spread evenly over the lung; each, from the hilum outwards, joins what is there already where it is nearest
/// (as in constrained constructive optimisation, Schreiner and Buxbaum 1993, IEEE Trans Biomed Eng 40:482, without its
/// optimisation). Radii follow Murray: r_0^3 = r_1^3 + r_2^3 (1926, PNAS 12:207); of human pulmonary arteries 2.6 is
/// measured too (from the ratios of Huang 1996, J Appl Physiol 81:2123 [from memory]), with which the few largest of as
/// many ends would be too wide.
#include <functional>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// A straight piece, thicker at `a`.
struct LungVessel {
  Eigen::Vector3d a, b;
  double radius_a_m = 0, radius_b_m = 0;
};

struct LungVesselOptions {
  int ends = 1600;  ///< of each of the four trees
  double end_radius_m = 0.46e-3;
  std::uint64_t seed = 1;
};

/// Of both lungs; `lung`: distance in m to the lungs' surface, negative inside.
std::vector<LungVessel> grow_lung_vessels(const std::function<double(const Eigen::Vector3d&)>& lung,
                                          const LungVesselOptions& options);

/// Closed rods of five or eight sides, about as thick: where a vessel divides, the thicker branch goes on in the same
/// rod, the others begin within its wall. One rod a piece would count twice what they share, and vessels seen end-on
/// would be rows of dark discs.
Mesh mesh_of(const std::vector<LungVessel>& vessels);

}  // namespace ostium::vascular
