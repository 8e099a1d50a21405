/// The clocks do not begin together: the frames, and with them the phase of the beat, or the injection.
#include "data/identification/curves/density/density.h"

namespace ostium::data::density {

Effect late_film() {
  Effect effect;
  effect.head.id = "trigger_delay", effect.head.form = "of the film";
  effect.head.what = "a film that was started too late or too early";
  effect.head.parameters = {{"s", "s", "true times of the frames minus those declared", 0, 0.1, -1, 1, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.film_later_s += v[0]; };
  return effect;
}

Effect late_injection() {
  Effect effect;
  effect.head.id = "trigger_delay", effect.head.form = "of the injection";
  effect.head.what = "an injection that began later or earlier than declared";
  effect.head.parameters = {{"s", "s", "true start of the injection minus that declared", 0, 0.1, -1, 1, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.injection_later_s += v[0]; };
  return effect;
}

}  // namespace ostium::data::density
