#include "fluoro/matter/spectrum.h"

#include <cmath>

#include "fluoro/matter/material.h"

namespace ostium::fluoro {

namespace {

constexpr double anode_path_m = 10e-6;  // tungsten crossed by the photons leaving the anode
constexpr double joule_per_keV = 1.602176634e-16;

double kerma_through_aluminium(const Spectrum& s, double aluminium_m) {
  double kerma = 0;
  for (Eigen::Index i = 0; i < s.energy_keV.size(); ++i)
    kerma += s.photons[i] * air_kerma_Gy_m2(s.energy_keV[i]) *
             std::exp(-attenuation_1_m(Material::aluminium, s.energy_keV[i]) * aluminium_m);
  return kerma;
}

}  // namespace

Spectrum spectrum(const XrayTube& tube) {
  constexpr int lowest_keV = 15;  // lower energies do not pass the filters
  const int bins = static_cast<int>(std::ceil(tube.peak_kV)) - lowest_keV;
  Spectrum s{Eigen::ArrayXd(bins), Eigen::ArrayXd(bins)};
  for (int i = 0; i < bins; ++i) {
    const double low = lowest_keV + i, width = std::min(1.0, tube.peak_kV - low), energy = low + 0.5 * width;
    const double depth = attenuation_1_m(Material::tungsten, energy) * anode_path_m +
                         attenuation_1_m(Material::aluminium, energy) * 1e-3 * tube.aluminium_mm +
                         attenuation_1_m(Material::copper, energy) * 1e-3 * tube.copper_mm;
    s.energy_keV[i] = energy;
    s.photons[i] = width * (tube.peak_kV / energy - 1) * std::exp(-depth);
  }
  return s;
}

double air_kerma_Gy_m2(double energy_keV) {
  return energy_keV * joule_per_keV * mass_energy_absorption_m2_kg(Material::air, energy_keV);
}

double half_value_layer_mm(const Spectrum& s) {
  const double open = kerma_through_aluminium(s, 0);
  double low = 0, high = 0.05;
  while (high - low > 1e-7) {
    const double middle = 0.5 * (low + high);
    (kerma_through_aluminium(s, middle) > 0.5 * open ? low : high) = middle;
  }
  return 1e3 * low;
}

}  // namespace ostium::fluoro
