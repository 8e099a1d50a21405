#include "fluoro/detector/attenuation.h"

#include <algorithm>

#include "fluoro/base/lanes.h"

namespace ostium::fluoro {

void attenuate(const Beam& beam, const Plane& stretch, const PathLengths& lengths, const ShaftLayer& shafts,
               Primary& out) {
  const Eigen::Index rows = stretch.rows(), columns = stretch.cols();
  out.signal_keV.resize(rows, columns);
  out.variance_keV2.resize(rows, columns);
  const PerEnergy &soft = beam.mu(Material::soft_tissue), &bone = beam.mu(Material::cortical_bone),
                  &iodine = beam.mu(Material::iodine);
  Floats least_m{}, unmatched{};
  for (Eigen::Index row = 0; row < rows; ++row) {
    const auto [from, to] = shafts.touched[std::size_t(row)];
    for (Eigen::Index column = 0; column < columns; column += lanes) {
      const int here = static_cast<int>(std::min<Eigen::Index>(lanes, columns - column));
      const auto of = [&](const Plane& plane) { return load(plane.row(row).data() + column, here); };
      Floats soft_m = of(lengths.soft_m()), bone_m = of(lengths.bone_m()), iodine_kg_m2 = of(lengths.iodine_kg_m2());
      least_m = least(least_m, least(least(soft_m, bone_m), iodine_kg_m2 * (1 / leak_iodine_kg_m3)));
      const Floats turns = of(lengths.unmatched()), along = of(stretch);
      unmatched += turns * turns;
      soft_m = most(soft_m, Floats{}) * along;
      bone_m = most(bone_m, Floats{}) * along;
      iodine_kg_m2 = most(iodine_kg_m2, Floats{}) * along;
      const bool has_shaft = column < to && column + lanes > from;
      Floats signal{}, variance{};
      for (std::size_t b = 0; b < energies; ++b) {
        const float keV = beam.energy_keV[b];
        Floats depth = soft[b] * soft_m + bone[b] * bone_m + iodine[b] * iodine_kg_m2;
        if (has_shaft) depth += of(shafts.optical_depth[b]);
        const Floats left = exponential(-depth) * (beam.photons[b] * keV);
        signal += left;
        variance += keV * left;
      }
      store(signal, out.signal_keV.row(row).data() + column, here);
      store(variance, out.variance_keV2.row(row).data() + column, here);
    }
  }
  out.leaks = false;
  for (int i = 0; i < lanes; ++i) out.leaks |= least_m[i] < leak_m || unmatched[i] > 0;
}

}  // namespace ostium::fluoro
