/// Walls rub more or less than declared (Coulomb). What a wire's stiffness presses with is known only to the scale of
/// EI; friction shows in how a force at the tip grows towards the hand, exp(mu angle).
#include "data/identification/curves/push_pull/push_pull.h"

namespace ostium::data::push_pull {

Effect wall_friction() {
  Effect effect;
  effect.head.id = "wall_friction";
  effect.head.what = "friction at the walls other than declared";
  effect.head.parameters = {{"friction", "1", "coefficient of friction at the walls", 0.1, 0.7, 1e-3, 2, true}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.friction = v[0]; };
  effect.adapt = [](const Setup& declared, std::vector<EffectParameter>& parameters) {
    parameters[0].prior = declared.friction;
  };
  return effect;
}

}  // namespace ostium::data::push_pull
