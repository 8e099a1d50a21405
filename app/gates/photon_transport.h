#pragma once
/// Photons one by one through a slab of soft tissue: what the scatter model is fitted to and checked against.
/// Incoherent scatter with bound electrons, coherent scatter and photoelectric absorption, cross-sections and angles
/// from xraylib.
#include <cstdint>
#include <vector>

#include "fluoro/matter/beam.h"

namespace ostium::app::gates {

struct SlabExperiment {
  fluoro::XrayTube tube{80, 3, 0.2};
  fluoro::Detector detector;
  double slab_m = 0.2;  ///< centred on the isocentre
  double source_to_isocentre_m = 0.765;
  double source_to_detector_m = 1.1;
  double grid_ratio = 12;          ///< height of the lead strips over their gap, focused on the source
  double grid_transmission = 0.7;  ///< of what comes straight from the source
};

struct SlabResult {
  double primary_keV = 0;  ///< absorbed in the detector per photon that left the tube
  double scatter_keV = 0;  ///< all of it, however far from the axis
  /// Share of the scatter that lands within a square of that half side round the axis, at the detector.
  std::vector<double> half_side_m, share_within;
  double mean_energy_keV = 0;  ///< of scattered photons that arrive
};

/// A pencil beam along the axis. By symmetry share_within is what the middle of a square field of that size gets, in
/// shares of what an unbounded one would.
SlabResult through_slab(const SlabExperiment& experiment, long photons, std::uint64_t seed);

}  // namespace ostium::app::gates
