#include "fluoro/matter/material.h"

#include <gtest/gtest.h>

#include "fluoro/matter/beam.h"
#include "fluoro/matter/tissue.h"

namespace ostium::fluoro {
namespace {

TEST(Material, AttenuationIsThatOfTheTables) {
  // NIST XCOM: mass attenuation with coherent scatter, cm2/g.
  EXPECT_NEAR(10 * mass_attenuation_m2_kg(Material::water, 60), 0.2059, 0.001);
  EXPECT_NEAR(10 * mass_attenuation_m2_kg(Material::iodine, 60), 7.579, 0.04);
  EXPECT_NEAR(10 * mass_attenuation_m2_kg(Material::iodine, 40), 22.10, 0.15);
  EXPECT_NEAR(10 * mass_attenuation_m2_kg(Material::aluminium, 60), 0.2778, 0.003);
  EXPECT_NEAR(10 * mass_attenuation_m2_kg(Material::copper, 60), 1.593, 0.01);
  EXPECT_NEAR(10 * mass_attenuation_m2_kg(Material::platinum, 60), 4.339, 0.05);
}

TEST(Material, AirKermaIsThatOfTheTables) {
  // NIST: mass energy-absorption of dry air, cm2/g.
  EXPECT_NEAR(10 * mass_energy_absorption_m2_kg(Material::air, 40), 0.06833, 0.0014);
  EXPECT_NEAR(10 * mass_energy_absorption_m2_kg(Material::air, 60), 0.03041, 0.0006);
  EXPECT_NEAR(10 * mass_energy_absorption_m2_kg(Material::air, 100), 0.02325, 0.0005);
}

TEST(Material, TwoBasisMaterialsMakeEveryTissue) {
  struct Known {
    Tissue tissue;
    double at_40, at_60, at_80;  // 1/cm, xraylib's compositions at the densities of tissue.h
  };
  const std::vector<Known> known{{tissue::blood, 0.286, 0.217, 0.193},
                                 {tissue::muscle, 0.280, 0.213, 0.190},
                                 {tissue::adipose, 0.220, 0.182, 0.166},
                                 {tissue::lung, 0.070, 0.053, 0.047}};
  for (const Known& k : known)
    for (auto [keV, expected] : {std::pair(40.0, k.at_40), std::pair(60.0, k.at_60), std::pair(80.0, k.at_80)}) {
      const double mixed = double(k.tissue.soft) * attenuation_1_m(Material::soft_tissue, keV) +
                           double(k.tissue.bone) * attenuation_1_m(Material::cortical_bone, keV);
      EXPECT_NEAR(mixed / 100, expected, 0.01 * expected + 0.0005) << keV;
    }
}

TEST(Beam, TheDetectorSeesTheWholeSpectrum) {
  const XrayTube tube{80, 3, 0.2};
  const Beam beam = make_beam(tube, {});
  const Spectrum s = spectrum(tube);
  double keV = 0, kerma = 0;
  for (Eigen::Index i = 0; i < s.photons.size(); ++i) {
    keV += s.photons[i] / s.photons.sum() * absorbed_share({}, s.energy_keV[i]) * s.energy_keV[i];
    kerma += s.photons[i] / s.photons.sum() * air_kerma_Gy_m2(s.energy_keV[i]);
  }
  EXPECT_NEAR(beam.open_keV() / keV, 1, 0.005);
  EXPECT_NEAR(beam.kerma_out_Gy_m2 / kerma, 1, 1e-6);
}

}  // namespace
}  // namespace ostium::fluoro
