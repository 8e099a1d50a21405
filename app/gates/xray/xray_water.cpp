#include "app/gates/xray/xray_water.h"

#include <cmath>

namespace ostium::app::gates {

Absorbed absorbed_by_keV(const fluoro::XrayTube& tube, const fluoro::Detector& detector, double soft_m, double bone_m,
                         double iodine_kg_m2) {
  const fluoro::Spectrum s = spectrum(tube);
  Absorbed out;
  for (Eigen::Index i = 0; i < s.photons.size(); ++i) {
    const double keV = s.energy_keV[i];
    const double depth = attenuation_1_m(fluoro::Material::soft_tissue, keV) * soft_m +
                         attenuation_1_m(fluoro::Material::cortical_bone, keV) * bone_m +
                         attenuation_1_m(fluoro::Material::iodine, keV) * iodine_kg_m2;
    const double arrive = s.photons[i] / s.photons.sum() * absorbed_share(detector, keV) * std::exp(-depth);
    out.keV += arrive * keV;
    out.keV2 += arrive * keV * keV;
  }
  return out;
}

}  // namespace ostium::app::gates
