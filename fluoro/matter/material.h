#pragma once
/// Materials in the beam and their attenuation.
#include <cstddef>

namespace ostium::fluoro {

enum class Material {
  air,
  water,
  soft_tissue,
  cortical_bone,
  iodine,  // the patient
  polymer,
  polymer_barium,
  steel,
  nitinol,
  cobalt_chromium,
  platinum,
  tungsten,
  gold,  // instruments
  aluminium,
  copper,
  caesium_iodide  // tube and detector
};
inline constexpr std::size_t materials = static_cast<std::size_t>(Material::caesium_iodide) + 1;

/// Photoelectric, incoherent and coherent together (xraylib 4, XCOM-type data), m2/kg. Energies 10 to 150 keV.
double mass_attenuation_m2_kg(Material material, double energy_keV);
/// For iodine 1 kg/m3, so that concentration times length plays the part of thickness times density.
double density_kg_m3(Material material);
double attenuation_1_m(Material material, double energy_keV);
/// Photoelectric absorption and the recoil electrons' share of incoherent scatter, m2/kg; for air it gives air kerma.
/// Neglects escaping fluorescence: accurate for light elements.
double mass_energy_absorption_m2_kg(Material material, double energy_keV);

}  // namespace ostium::fluoro
