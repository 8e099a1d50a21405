#include "vascular/contrast/advection.h"

#include <algorithm>
#include <cmath>

namespace ostium::vascular {

void carry(std::span<const double> mass, std::span<const double> volume, std::span<const double> passing_m3,
           double inlet_kg_m3, std::span<double> through_kg, CarryScratch& x) {
  const int n = static_cast<int>(mass.size());
  x.kg_m3.resize(n + 2), x.slope.resize(n);
  double* const c = x.kg_m3.data() + 1;  // c[-1] is upstream of the first cell, c[n] downstream of the last
  c[-1] = inlet_kg_m3;
  for (int i = 0; i < n; ++i) c[i] = mass[i] / volume[i];
  c[n] = c[n - 1];
  for (int i = 0; i < n; ++i) {
    const double below = c[i] - c[i - 1], above = c[i + 1] - c[i];
    const double limited = std::min({std::fabs(below + above) / 2, 2 * std::fabs(below), 2 * std::fabs(above)});
    x.slope[i] = below * above > 0 ? std::copysign(limited, below) : 0;
  }
  for (int face = 0; face <= n; ++face) {
    double left = passing_m3[face], sum = 0;
    int i = face - 1;
    for (; i >= 0 && left >= volume[i]; --i) sum += mass[i], left -= volume[i];
    if (i < 0) {
      through_kg[face] = sum + inlet_kg_m3 * left;
    } else {
      const double part = left / volume[i];  // share of the cell next to the face
      through_kg[face] = sum + mass[i] * part + x.slope[i] * volume[i] * part * (1 - part) / 2;
    }
  }
}

}  // namespace ostium::vascular
