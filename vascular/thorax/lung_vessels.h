#pragma once
/// Arteries and veins of the lungs, which a chest X-ray shows as branching lines and mottle.
///
/// Ends are spread evenly over the lung; each, from the hilum outwards, joins what is there already where it is nearest
/// (as in constrained constructive optimisation, Schreiner and Buxbaum 1993, IEEE Trans Biomed Eng 40:482, without its
/// optimisation). Radii follow r_0^e = r_1^e + r_2^e with e = 2.6: the ratios of diameters 1.56 and of numbers 3.2 from
/// order to order of human pulmonary arteries (Huang 1996, J Appl Physiol 81:2123) [from memory].
#include <functional>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// A straight piece, thicker at `a`.
struct LungVessel {
  Eigen::Vector3d a, b;
  double radius_a_m = 0, radius_b_m = 0;
};

struct LungVesselOptions {
  int ends = 800;  ///< of each of the four trees
  double end_radius_m = 0.48e-3;
  std::uint64_t seed = 1;
};

/// Of both lungs; `lung`: distance in m to the lungs' surface, negative inside.
std::vector<LungVessel> grow_lung_vessels(const std::function<double(const Eigen::Vector3d&)>& lung,
                                          const LungVesselOptions& options);

/// Closed five-sided rods, about as thick.
Mesh mesh_of(const std::vector<LungVessel>& vessels);

}  // namespace ostium::vascular
