#include "data/identification/effects/effect.h"

namespace ostium::data {

std::string ActiveEffect::name() const {
  std::string out = effect->id;
  if (instrument) out += "[" + std::to_string(*instrument) + "]";
  return form.empty() ? out : out + " (" + form + ")";
}

std::vector<EffectParameter> parameters_of(const Effect& effect, const MeasurementSet& set,
                                           std::optional<int> instrument) {
  std::vector<EffectParameter> parameters = effect.parameters;
  if (effect.adapt) effect.adapt(set, instrument, parameters);
  return parameters;
}

ActiveEffect active(const Effect& effect, const MeasurementSet& set, std::optional<int> instrument,
                    const EffectForm& form) {
  ActiveEffect out{&effect, instrument, {}, {}, form.name};
  for (const EffectParameter& p : parameters_of(effect, set, instrument)) {
    out.values.push_back(p.prior), out.held.push_back(false);
    for (const auto& [name, value] : form.held)
      if (name == p.name) out.values.back() = value, out.held.back() = true;
  }
  return out;
}

}  // namespace ostium::data
