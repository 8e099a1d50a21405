#pragma once
/// A chest made from formulas, for fluoro's own tests and pictures. Not an anatomy: only the points that coronary
/// arteries pass through are published (Dodge et al. 1988, Circulation 78:1167, tables 3 to 5, right-dominant men); the
/// rest has usual sizes and is generated from fixed seeds. With an anatomy, fill a Scene instead.
///
/// Frame P with the isocentre in the heart's middle.
#include "fluoro/matter/scene.h"

namespace ostium::fluoro::phantom {

enum class Filling { none, left, right, both };  ///< which coronary holds contrast

struct ChestOptions {
  Filling filling = Filling::none;
  double iodine_kg_m3 = 300;     ///< in the filled coronary and its guide
  double stenosis = 0.6;         ///< by diameter, in the LAD and the RCA; 0: none
  bool instruments = true;       ///< guide, wire, balloon markers
  bool left_instruments = true;  ///< in the left coronary; false: in the right one
};

Scene chest(const ChestOptions& options);

/// The narrowest point of the stenosis and the vessel's healthy diameter there.
struct Lesion {
  Eigen::Vector3d p_P;
  double healthy_diameter_m = 0;
};
Lesion lesion(bool left);

}  // namespace ostium::fluoro::phantom
