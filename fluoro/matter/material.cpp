#include "fluoro/matter/material.h"

#include <xraylib.h>

#include <array>
#include <cassert>

namespace ostium::fluoro {

namespace {

struct Recipe {
  const char* compound;  // in the notation of xraylib's parser or its NIST list
  double density_kg_m3;
  double share = 1;  // mass fraction, the rest is `rest`
  const char* rest = nullptr;
};

/// In the order of the enumeration.
constexpr std::array<Recipe, 16> recipes{{
    {"Air, Dry (near sea level)", 1.205},
    {"H2O", 1000},
    {"Tissue, Soft (ICRP)", 1000},
    {"Bone, Cortical (ICRP)", 1850},
    {"I", 1},
    {"C12H22N2O", 1060},                   // nylon, PEBAX
    {"BaSO4", 1330, 0.25, "C12H22N2O"},    // catheter walls, a quarter barium sulphate by mass
    {"Fe0.68Cr0.185Ni0.12Mo0.015", 8000},  // 316L, atomic fractions
    {"NiTi", 6450},
    {"Co0.545Cr0.235Ni0.105W0.05Mn0.015Fe0.02", 9100},  // L605, atomic fractions
    {"Pt", 21450},
    {"W", 19250},
    {"Au", 19300},
    {"Al", 2699},
    {"Cu", 8960},
    {"CsI", 4510},
}};

const Recipe& recipe(Material material) { return recipes[static_cast<std::size_t>(material)]; }

double mixed(const Recipe& r, double energy_keV, double (*cross_section)(const char*, double, xrl_error**)) {
  const auto m2_kg = [&](const char* compound) {
    xrl_error* error = nullptr;
    const double cm2_g = cross_section(compound, energy_keV, &error);
    assert(!error);
    return 0.1 * cm2_g;
  };
  return r.share * m2_kg(r.compound) + (r.rest ? (1 - r.share) * m2_kg(r.rest) : 0);
}

/// Mean share of a photon's energy transferred to the recoil electron (Klein and Nishina 1929).
double compton_transfer(double energy_keV) {
  constexpr int steps = 200;
  const double a = energy_keV / 510.999;
  double scattered = 0, transferred = 0;
  for (int i = 0; i < steps; ++i) {
    const double cosine = -1 + (i + 0.5) * 2 / steps;
    const double kept = 1 / (1 + a * (1 - cosine));
    const double per_angle = kept * kept * (kept + 1 / kept - 1 + cosine * cosine);
    scattered += per_angle;
    transferred += per_angle * (1 - kept);
  }
  return transferred / scattered;
}

}  // namespace

double mass_attenuation_m2_kg(Material material, double energy_keV) {
  return mixed(recipe(material), energy_keV, CS_Total_CP);
}

double density_kg_m3(Material material) { return recipe(material).density_kg_m3; }

double attenuation_1_m(Material material, double energy_keV) {
  return density_kg_m3(material) * mass_attenuation_m2_kg(material, energy_keV);
}

double mass_energy_absorption_m2_kg(Material material, double energy_keV) {
  return mixed(recipe(material), energy_keV, CS_Photo_CP) +
         compton_transfer(energy_keV) * mixed(recipe(material), energy_keV, CS_Compt_CP);
}

}  // namespace ostium::fluoro
