#include "core/model/nesting.h"

#include <algorithm>

namespace ostium::core {

std::vector<Nesting> coaxial(const std::vector<int>& rods) {
  std::vector<Nesting> out;
  for (std::size_t inner = 1; inner < rods.size(); ++inner)
    for (std::size_t outer = 0; outer < inner; ++outer) out.push_back({.outer = rods[outer], .inner = rods[inner]});
  return out;
}

bool is_nested(const std::vector<Nesting>& nestings, int outer, int inner) {
  return std::any_of(nestings.begin(), nestings.end(),
                     [&](const Nesting& n) { return n.outer == outer && n.inner == inner; });
}

double tightest_clearance_m(const Rod& outer, const Rod& inner, double lumen_m) {
  double bore = 1e3, thickest = 0;
  for (const Section& s : outer.sections)
    if (s.from_tip_m < lumen_m) bore = std::min(bore, s.inner_radius_m);
  for (const Section& s : inner.sections) thickest = std::max(thickest, s.radius_m);
  return bore - thickest;
}

}  // namespace ostium::core
