#pragma once
/// Monte Carlo of single photons through a slab of soft tissue; the scatter model is fitted to it and checked against
/// it. Incoherent scatter with bound electrons, coherent scatter and photoelectric absorption, with cross-sections and
/// angles from xraylib.
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
  double grid_ratio = 12;          ///< height of the lead strips over the gap between them; focused on the source
  double grid_transmission = 0.7;  ///< of primary radiation
};

struct SlabResult {
  double primary_keV = 0;  ///< absorbed in the detector per photon that left the tube
  double scatter_keV = 0;  ///< total scatter, at any distance from the axis
  /// Share of the scatter within a square of that half side around the axis, at the detector.
  std::vector<double> half_side_m, share_within;
  double mean_energy_keV = 0;  ///< of scattered photons at the detector
};

/// A pencil beam along the axis. By symmetry, share_within is also the scatter at the middle of a square field of that
/// size relative to an unbounded one.
SlabResult through_slab(const SlabExperiment& experiment, long photons, std::uint64_t seed);

}  // namespace ostium::app::gates
