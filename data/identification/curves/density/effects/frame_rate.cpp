/// The film ran at another rate than is written: all times are wrong by one factor.
#include "data/identification/curves/density/density.h"

namespace ostium::data::density {

Effect frame_rate() {
  Effect effect;
  effect.head.id = "frame_rate";
  effect.head.what = "frames that came faster or slower than declared";
  effect.head.parameters = {{"factor", "1", "true times against those declared", 1, 0.2, 0.3, 3, true}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.time_scale = v[0]; };
  return effect;
}

}  // namespace ostium::data::density
