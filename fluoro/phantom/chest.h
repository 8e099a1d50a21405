#pragma once
/// A chest made from formulas, for fluoro's own tests and pictures. It is no anatomy: only the points that coronary
/// arteries run through are from a publication (Dodge et al. 1988, Circulation 78:1167, tables 3 to 5, right-dominant
/// men); the rest is of usual size and grown from fixed seeds. Whoever has an anatomy fills a Scene with it instead.
///
/// Frame P with the isocentre in the heart's middle.
#include "fluoro/matter/scene.h"

namespace ostium::fluoro::phantom {

enum class Filling { none, left, right, both };  ///< which coronary holds contrast

struct ChestOptions {
  Filling filling = Filling::none;
  double iodine_kg_m3 = 300;     ///< in the filled coronary and its guide
  double stenosis = 0.6;         ///< by diameter, of the LAD and of the RCA; 0: none
  bool instruments = true;       ///< guide, wire, balloon markers
  bool left_instruments = true;  ///< into the left coronary; false: the right one
};

Scene chest(const ChestOptions& options);

/// The narrowest place of the stenosis and the vessel's healthy diameter there.
struct Lesion {
  Eigen::Vector3d p_P;
  double healthy_diameter_m = 0;
};
Lesion lesion(bool left);

}  // namespace ostium::fluoro::phantom
