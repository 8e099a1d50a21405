/// The artery runs towards the tube or away from it, all of it or a stretch: lengths along it look shorter, so that
/// more iodine lies on each mm of the picture, and a site lies further from the ostium than it seems.
#include "data/identification/curves/density/density.h"

namespace ostium::data::density {

Effect foreshortening() {
  Effect effect;
  effect.head.id = "foreshortening", effect.head.form = "everywhere";
  effect.head.what = "an artery that is seen shorter than it is";
  effect.head.parameters = {{"factor", "1", "lengths as seen against true ones", 0.9, 0.15, 0.3, 1.2, true}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.foreshortened = {0, 10, v[0]}; };
  return effect;
}

Effect foreshortened_stretch() {
  Effect effect;
  effect.head.id = "foreshortening", effect.head.form = "of a stretch";
  effect.head.what = "a stretch of the artery that is seen shorter than it is";
  effect.head.parameters = {{"from_mm", "mm", "where it begins", 0, 0, 0, 0, false},
                            {"length_mm", "mm", "its true length", 30, 0.7, 5, 150, true},
                            {"factor", "1", "lengths as seen against true ones", 0.85, 0.15, 0.3, 1.2, true}};
  effect.adapt = along_the_sites;
  effect.apply = [](const std::vector<double>& v, Setup& setup) {
    setup.foreshortened = {v[0] * 1e-3, (v[0] + v[1]) * 1e-3, v[2]};
  };
  return effect;
}

}  // namespace ostium::data::density
