#pragma once
/// Quantum noise: as many photons as the dose brings, no more.
#include <cstdint>

#include "fluoro/base/plane.h"

namespace ostium::fluoro {

/// Which draw: the same three numbers give the same noise, in any order and on any thread.
struct NoiseKey {
  std::uint64_t seed = 0, frame = 0;
};

/// What arrives at the detector before its photons are counted.
struct Arriving {
  const Plane& signal_keV;     ///< primary, per photon that left the tube
  const Plane& variance_keV2;  ///< of it
  const Plane& scatter_keV;    ///< to be added; its photons are as energetic as the primary ones
  double photons = 0;          ///< that left the tube towards a pixel
  double unit_keV = 1;         ///< energy of one unit of the result
  double swank = 1;            ///< Detector::swank
};

/// Signal with quantum noise, never below 0: mean (signal + scatter) photons / unit, variance as counted energies have.
/// Deviates are quantiles of the normal distribution drawn by a hash of key, row and column: 65536 of them, to 4.3
/// standard deviations, of mean 0 and variance 1.
void count_photons(const NoiseKey& key, const Arriving& in, Plane& out);

}  // namespace ostium::fluoro
