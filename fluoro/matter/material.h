#pragma once
/// What X-rays meet, and how much of them it takes away.
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
/// Of iodine: 1 kg/m3, so that concentration times length counts as thickness times density.
double density_kg_m3(Material material);
double attenuation_1_m(Material material, double energy_keV);
/// Photoelectric absorption and the recoil electrons' share of incoherent scatter, m2/kg; of air it gives air kerma.
/// Neglects fluorescence that escapes: right for light elements.
double mass_energy_absorption_m2_kg(Material material, double energy_keV);

}  // namespace ostium::fluoro
