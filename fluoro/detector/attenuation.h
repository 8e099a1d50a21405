#pragma once
/// The primary beam after the patient.
#include "fluoro/matter/beam.h"
#include "fluoro/projection/path_lengths.h"
#include "fluoro/projection/shaft_layer.h"

namespace ostium::fluoro {

/// For each pixel, per photon that left the tube towards it.
struct Primary {
  Plane signal_keV;     ///< energy absorbed in the detector
  Plane variance_keV2;  ///< of that energy, with Poisson statistics
  bool leaks = false;   ///< a length was negative or a surface open; see find_leak
};

/// Beer-Lambert attenuation at each of the beam's energies (beam.h). All planes have the same size. Negative lengths
/// count as zero.
void attenuate(const Beam& beam, const Plane& stretch, const PathLengths& lengths, const ShaftLayer& shafts,
               Primary& out);

}  // namespace ostium::fluoro
