#pragma once
/// The spectrum of the X-ray tube.
#include <Eigen/Core>

namespace ostium::fluoro {

struct XrayTube {
  double peak_kV = 75;      ///< [50, 125]
  double aluminium_mm = 3;  ///< permanent filtration, including inherent
  double copper_mm = 0.2;   ///< added: [0, 0.9]
  bool operator==(const XrayTube&) const = default;
};

/// Photons in bins of 1 keV.
struct Spectrum {
  Eigen::ArrayXd energy_keV;  ///< bin centres, ascending
  Eigen::ArrayXd photons;     ///< in units of Kramers' constant; only ratios matter
};

/// Kramers' bremsstrahlung, N(E) dE ~ (kV / E - 1) dE, through 10 um of the anode's tungsten (self-absorption) and the
/// filters. Characteristic lines (above 69.5 kV, a few per cent of photons at 80 kV) are omitted.
Spectrum spectrum(const XrayTube& tube);

/// Air kerma of one photon per m2, Gy m2.
double air_kerma_Gy_m2(double energy_keV);

/// Thickness of aluminium that halves the air kerma, mm.
double half_value_layer_mm(const Spectrum& spectrum);

}  // namespace ostium::fluoro
