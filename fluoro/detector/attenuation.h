#pragma once
/// What is left of the beam behind the patient.
#include "fluoro/matter/beam.h"
#include "fluoro/projection/path_lengths.h"
#include "fluoro/projection/shaft_layer.h"

namespace ostium::fluoro {

/// Of each pixel, per photon that left the tube towards it.
struct Primary {
  Plane signal_keV;     ///< energy absorbed in the detector
  Plane variance_keV2;  ///< of it, for Poisson photons
  bool leaks = false;   ///< a length was negative or a surface open; find_leak says more
};

/// Beer and Lambert's law at each of the beam's energies (beam.h). All planes are of one size. Negative lengths count
/// as none.
void attenuate(const Beam& beam, const Plane& stretch, const PathLengths& lengths, const ShaftLayer& shafts,
               Primary& out);

}  // namespace ostium::fluoro
