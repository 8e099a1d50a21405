#pragma once
/// A polychromatic beam at five energies, as the detector sees it.
///
/// The signal of a ray is the energy that the detector absorbs, S = sum_E n(E) E exp(-tau(E)), tau = sum_m mu_m(E) L_m.
/// Summed over a spectrum in steps of 1 keV that is some sixty exponentials a pixel. Five do as well: the nodes and
/// weights of the Gauss quadrature, in the variable mu_soft(E), of what arrives behind `hardening_m` of soft tissue
/// (Golub and Welsch 1969, Math Comp 23:221): exact for every polynomial of degree 9 in mu_soft.
#include <array>

#include "fluoro/matter/material.h"
#include "fluoro/matter/spectrum.h"

namespace ostium::fluoro {

inline constexpr int energies = 5;
using PerEnergy = std::array<float, energies>;

struct Detector {
  double caesium_iodide_mm = 0.6;  ///< thickness of the scintillator
  double packing = 0.75;           ///< share of it that is solid: it grows as needles
  double swank = 0.9;              ///< what the spread of light per photon leaves of the signal-to-noise ratio squared
};

struct Beam {
  PerEnergy energy_keV;  ///< E_b, falling
  PerEnergy photons;     ///< n_b: photons absorbed with nothing in between, per photon that left the tube
  std::array<PerEnergy, materials> mu_1_m;  ///< attenuation of each material; of iodine at 1 kg/m3
  PerEnergy kerma_Gy_m2;         ///< air kerma in front of the detector of as many photons as give one absorbed one
  double kerma_out_Gy_m2 = 0;    ///< air kerma of one photon as it left the tube
  double hardened_soft_1_m = 0;  ///< mean attenuation of soft tissue from 0 to hardening_m of it

  const PerEnergy& mu(Material material) const { return mu_1_m[static_cast<std::size_t>(material)]; }
  double open_keV() const;          ///< signal per photon that left the tube, with nothing in between
  double photons_absorbed() const;  ///< of one that left the tube, with nothing in between
};

/// Share of the photons of that energy that the detector absorbs.
double absorbed_share(const Detector& detector, double energy_keV);

Beam make_beam(const XrayTube& tube, const Detector& detector, double hardening_m = 0.2);

}  // namespace ostium::fluoro
