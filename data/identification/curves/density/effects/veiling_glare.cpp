/// Light or scatter from elsewhere is added to every density: always the same, or a share of what the whole artery
/// shows (Seibert, Nalcioglu, Roeck 1984, Med Phys 11:172: a wide, weak halo around each point).
#include "data/identification/curves/density/density.h"

namespace ostium::data::density {

Effect constant_glare() {
  Effect effect;
  effect.head.id = "veiling_glare", effect.head.form = "constant";
  effect.head.what = "a density that is always added";
  effect.head.parameters = {{"mm", "mm", "what is added", 0, 0.3, -3, 3, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.glare_m += v[0] * 1e-3; };
  return effect;
}

Effect glare_of_neighbours() {
  Effect effect;
  effect.head.id = "veiling_glare", effect.head.form = "of neighbours";
  effect.head.what = "a halo of the whole artery that is added to each site";
  effect.head.parameters = {{"share", "1", "of the mean density of all sites", 0, 0.2, -0.6, 1, false}};
  effect.head.confused_with = "concentration";
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.glare_share += v[0]; };
  return effect;
}

}  // namespace ostium::data::density
