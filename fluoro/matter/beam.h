#pragma once
/// A polychromatic beam at five energies, as the detector sees it.
///
/// The signal of a ray is the energy that the detector absorbs, S = sum_E n(E) E exp(-tau(E)), tau = sum_m mu_m(E) L_m.
/// Over a spectrum in steps of 1 keV that would be about sixty exponentials per pixel. Five suffice: the nodes and
/// weights of the Gauss quadrature, in the variable mu_soft(E), of the spectrum behind `hardening_m` of soft tissue
/// (Golub and Welsch 1969, Math Comp 23:221), exact for every polynomial of degree 9 in mu_soft.
#include <array>

#include "fluoro/matter/material.h"
#include "fluoro/matter/spectrum.h"

namespace ostium::fluoro {

inline constexpr int energies = 5;
using PerEnergy = std::array<float, energies>;

struct Detector {
  double caesium_iodide_mm = 0.6;  ///< thickness of the scintillator
  double packing = 0.75;           ///< solid share of that: it grows as needles
  double swank = 0.9;              ///< factor on the squared signal-to-noise ratio from the spread of light per photon
};

struct Beam {
  PerEnergy energy_keV;  ///< E_b, descending
  PerEnergy photons;     ///< n_b: absorbed photons with nothing in between, per photon that left the tube
  std::array<PerEnergy, materials> mu_1_m;  ///< attenuation of each material; for iodine at 1 kg/m3
  PerEnergy kerma_Gy_m2;                    ///< air kerma before the detector per absorbed photon
  double kerma_out_Gy_m2 = 0;               ///< air kerma per photon leaving the tube
  double hardened_soft_1_m = 0;             ///< mean attenuation of soft tissue over 0 to hardening_m

  const PerEnergy& mu(Material material) const { return mu_1_m[static_cast<std::size_t>(material)]; }
  double open_keV() const;          ///< signal per photon that left the tube, with nothing in between
  double photons_absorbed() const;  ///< per photon that left the tube, with nothing in between
};

/// Share of the photons of that energy that the detector absorbs.
double absorbed_share(const Detector& detector, double energy_keV);

Beam make_beam(const XrayTube& tube, const Detector& detector, double hardening_m = 0.2);

}  // namespace ostium::fluoro
