#pragma once
/// Shared by the X-ray gates: slabs across the beam, and the beam summed in steps of 1 keV.
#include "fluoro/detector/imager.h"
#include "fluoro/matter/tissue.h"
#include "fluoro/phantom/shapes.h"

namespace ostium::app::gates {

/// A slab of tissue across the beam of an AP view, wider than the picture; its middle at the isocentre.
inline fluoro::Scene slab(double thickness_m, fluoro::Tissue tissue) {
  const double half = 0.5 * thickness_m;
  auto bodies = std::make_shared<std::vector<fluoro::Body>>();
  bodies->push_back(fluoro::phantom::body("slab", fluoro::phantom::brick({-0.2, -0.2, -half}, {0.2, 0.2, half}), tissue,
                                          fluoro::tissue::air));
  return {bodies, {}, {}};
}

/// What the detector absorbs per photon that left the tube, summed over the spectrum in steps of 1 keV.
struct Absorbed {
  double keV = 0, keV2 = 0;
};
Absorbed absorbed_by_keV(const fluoro::XrayTube& tube, const fluoro::Detector& detector, double soft_m, double bone_m,
                         double iodine_kg_m2);

}  // namespace ostium::app::gates
