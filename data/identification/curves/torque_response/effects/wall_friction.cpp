/// Walls rub more or less than declared: every contact resists with mu N r at most (Coulomb).
#include "data/identification/curves/torque_response/torque_response.h"

namespace ostium::data::torque_response {

namespace {

std::string no_contacts(const Setup& declared) {
  for (const Turning& run : declared.runs)
    for (const Contact& contact : run.contacts)
      if (contact.force_N > 0) return "";
  return "the wire touches nothing";
}

void about_declared(const Setup& declared, std::vector<EffectParameter>& parameters) {
  if (declared.friction > 0) parameters[0].prior = declared.friction;
}

}  // namespace

Effect wall_friction() {
  Effect effect;
  effect.head.id = "wall_friction";
  effect.head.what = "friction at the walls other than declared";
  effect.head.parameters = {{"friction", "1", "coefficient of friction at the contacts", 0.1, 0.7, 1e-3, 3, true}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.friction = v[0]; };
  effect.why_not = no_contacts, effect.adapt = about_declared;
  return effect;
}

}  // namespace ostium::data::torque_response
