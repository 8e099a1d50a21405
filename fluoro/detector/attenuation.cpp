#include "fluoro/detector/attenuation.h"

#include <algorithm>

namespace ostium::fluoro {

void attenuate(const Beam& beam, const Plane& stretch, const PathLengths& lengths, const ShaftLayer& shafts,
               Primary& out) {
  const Eigen::Index rows = stretch.rows(), columns = stretch.cols();
  out.signal_keV.resize(rows, columns);
  out.variance_keV2.resize(rows, columns);
  using Row = Eigen::Array<float, 1, Eigen::Dynamic>;
  Row left(columns), soft_m(columns), bone_m(columns), iodine_kg_m2(columns), unmatched(columns);
  const PerEnergy &soft = beam.mu(Material::soft_tissue), &bone = beam.mu(Material::cortical_bone),
                  &iodine = beam.mu(Material::iodine);
  out.leaks = false;
  for (Eigen::Index row = 0; row < rows; ++row) {  // one row at a time stays in the cache
    soft_m = lengths.soft_m().row(row);
    bone_m = lengths.bone_m().row(row);
    iodine_kg_m2 = lengths.iodine_kg_m2().row(row);
    unmatched = lengths.unmatched().row(row);
    const float least_m = std::min({soft_m.minCoeff(), bone_m.minCoeff(), iodine_kg_m2.minCoeff() / leak_iodine_kg_m3});
    if (least_m < leak_m || unmatched.maxCoeff() > 0 || unmatched.minCoeff() < 0) {
      out.leaks = true;
      soft_m = soft_m.max(0.0f);
      bone_m = bone_m.max(0.0f);
      iodine_kg_m2 = iodine_kg_m2.max(0.0f);
    }
    soft_m *= stretch.row(row);
    bone_m *= stretch.row(row);
    iodine_kg_m2 *= stretch.row(row);
    const auto [from, to] = shafts.touched[std::size_t(row)];
    auto signal = out.signal_keV.row(row), variance = out.variance_keV2.row(row);
    signal.setZero();
    variance.setZero();
    for (std::size_t b = 0; b < energies; ++b) {
      const float keV = beam.energy_keV[b];
      left = -soft[b] * soft_m - bone[b] * bone_m - iodine[b] * iodine_kg_m2;
      if (to > from) left.segment(from, to - from) -= shafts.optical_depth[b].row(row).segment(from, to - from);
      left = left.exp() * (beam.photons[b] * keV);
      signal += left;
      variance += keV * left;
    }
  }
}

}  // namespace ostium::fluoro
