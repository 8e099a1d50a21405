#pragma once
/// The coronary tree beyond the named branches, down to 0.3 mm, as an angiogram shows it. Drawn only: it is too thin
/// for an instrument, and flow takes it as the resistance behind the named branches.
///
/// A twig's diameter D falls from element to element by D^(7/3) = D_1^(7/3) + D_2^(7/3) (Huo and Kassab 2012, J R Soc
/// Interface 9:190, a minimum-work law like Murray's, who has 3). An element is 14 to 26 diameters long, 2 cm at most
/// [estimate, from the 10 to 30 of Kassab 1993, Am J Physiol 265:H350]. Twigs run on the heart's surface, winding as
/// they please; septals, from the LAD, dive towards the apex. The last element narrows to nothing, as what follows is
/// too thin to be seen.
#include "vascular/patient/patient.h"

namespace ostium::vascular {

struct Twigs {
  Mesh mesh;                          ///< closed rods, at end-diastole, breathed out
  std::vector<int> first;             ///< (#twigs + 1) vertices of each: [first[i], first[i + 1])
  std::vector<int> first_triangle;    ///< (#twigs + 1) likewise
  std::vector<int> root;              ///< (#twigs) vertex of the lumen from whose vessel it comes
  std::vector<Eigen::Vector3d> beat;  ///< per vertex: displacement at end-systole beyond that of its root
  std::vector<double> diameter_m;     ///< (#twigs) where it begins

  std::size_t size() const { return root.size(); }
  int vertices_of(std::size_t twig) const { return first[twig + 1] - first[twig]; }
  int triangles_of(std::size_t twig) const { return first_triangle[twig + 1] - first_triangle[twig]; }
};

/// The seed is made from the heart's landmarks: one person, one tree.
Twigs grow_twigs(const Patient& patient);

/// Vertices of one twig at a phase and a depth of breath.
void at(const Twigs& twigs, std::size_t twig, const MovingLumen& lumen, double phase, double breath,
        std::vector<Eigen::Vector3d>& out);

}  // namespace ostium::vascular
