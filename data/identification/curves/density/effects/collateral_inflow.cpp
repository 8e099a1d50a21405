/// Blood without contrast joins at a place: behind it the flow is larger, and the iodine thinner.
#include "data/identification/curves/density/density.h"

namespace ostium::data::density {

Effect collateral_inflow() {
  Effect effect;
  effect.head.id = "collateral_inflow";
  effect.head.what = "blood without contrast that flows in";
  effect.head.parameters = {{"at_mm", "mm", "where it joins", 0, 0, 0, 0, false},
                            {"share", "1", "of the flow before it", 0.2, 1, 0.01, 3, true}};
  effect.adapt = along_the_sites;
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.inflow = {v[0] * 1e-3, v[1]}; };
  return effect;
}

}  // namespace ostium::data::density
