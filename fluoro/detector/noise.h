#pragma once
/// Quantum noise from the number of photons in the dose.
#include <cstdint>

#include "fluoro/base/plane.h"

namespace ostium::fluoro {

/// Identifies a draw: the same three numbers give the same noise, in any order and on any thread.
struct NoiseKey {
  std::uint64_t seed = 0, frame = 0;
};

/// Signal at the detector before photon counting.
struct Arriving {
  const Plane& signal_keV;     ///< primary, per photon that left the tube
  const Plane& variance_keV2;  ///< of that energy
  const Plane& scatter_keV;    ///< to be added; its photons have the same energies as the primary ones
  double photons = 0;          ///< per pixel, at the tube
  double unit_keV = 1;         ///< energy of one unit of the result
  double swank = 1;            ///< Detector::swank
};

/// Signal with quantum noise, never below 0: mean (signal + scatter) photons / unit, with the variance of
/// energy-integrating counting. Deviates are normal quantiles selected by a hash of key, row and column: 65536 of them,
/// up to 4.3 standard deviations, with mean 0 and variance 1.
void count_photons(const NoiseKey& key, const Arriving& in, Plane& out);

}  // namespace ostium::fluoro
