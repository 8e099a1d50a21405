#include "vascular/treatment/drugs.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace ostium::vascular {

namespace {

constexpr std::uint64_t responds = 54;  // stream of random numbers

/// Whether an effect shows in this person; of the built-in adenosine for -1.
bool works(const DrugModel& m, int effect, double in_share) {
  return in_share >= 1 || core::uniform(m.seed, responds, static_cast<std::uint64_t>(effect + 1)) < in_share;
}

void step_others(const DrugModel& m, const Doses& doses, double dt, DrugState& s) {
  if (doses.drug >= 0 && static_cast<std::size_t>(doses.drug) < m.others.size() && doses.dose > 0 &&
      std::isfinite(doses.dose))
    s.amount[static_cast<std::size_t>(doses.drug)] += doses.dose;
  std::size_t e = 0;
  for (std::size_t d = 0; d < m.others.size(); ++d) {
    const Drug& drug = m.others[d];
    s.amount[d] *= std::exp2(-dt / drug.half_life_s);
    for (const DrugEffect& one : drug.effects) {
      const double share = -std::expm1(-dt / one.onset_s);
      if (one.target == DrugTarget::heparin) {
        // It is used up by what it binds.
        const double used = std::min(share * s.amount[d], s.heparin_U / one.most);
        s.amount[d] -= used, s.heparin_U -= used * one.most;
      }
      const double want = one.target == DrugTarget::heparin || !works(m, static_cast<int>(e), one.works_in)
                              ? 0
                              : one.most * s.amount[d] / (s.amount[d] + one.half_dose);
      s.effect[e] += share * (want - s.effect[e]);
      ++e;
    }
  }
}

}  // namespace

DrugState make_state(const DrugModel& m) {
  DrugState s;
  s.amount.assign(m.others.size(), 0);
  for (const Drug& drug : m.others) s.effect.resize(s.effect.size() + drug.effects.size(), 0);
  return s;
}

double effect_on(DrugTarget target, const DrugModel& m, const DrugState& s) {
  double sum = 0;
  std::size_t e = 0;
  for (const Drug& drug : m.others)
    for (const DrugEffect& one : drug.effects) {
      if (one.target == target) sum += s.effect[e];
      ++e;
    }
  return sum;
}

double opens_muscle(const DrugModel& m, const DrugState& s) {
  const double adenosine = s.adenosine > 0 && works(m, -1, m.adenosine_opens_in) ? s.adenosine : 0;
  return effect_on(DrugTarget::muscle, m, s) + adenosine;
}

void act(const DrugModel& m, const DrugState& s, CirculationInputs& body) {
  const auto sum = [&](DrugTarget target) { return effect_on(target, m, s); };
  body.dilation = m.nitrate_lowers * s.nitrate + sum(DrugTarget::dilation);
  body.constriction = sum(DrugTarget::resistance);
  body.contraction = 1 + sum(DrugTarget::contraction);
  body.rate_effect = sum(DrugTarget::rate);
  body.vagal_block = sum(DrugTarget::vagus);
}

void step(const DrugModel& m, const Doses& doses, double dt, DrugState& s) {
  const auto given = [](double dose) { return dose > 0 && std::isfinite(dose) ? dose : 0; };
  s.heparin_U = (s.heparin_U + given(doses.heparin_U)) * std::exp2(-dt / m.heparin_half_life_s);
  s.nitrate_ug = (s.nitrate_ug + given(doses.nitrate_ug)) * std::exp(-dt / m.nitrate_out_s);
  s.adenosine_ug = (s.adenosine_ug + given(doses.adenosine_ug)) * std::exp(-dt / m.adenosine_out_s);
  s.nitrate += -std::expm1(-dt / m.nitrate_in_s) * (s.nitrate_ug / (s.nitrate_ug + m.nitrate_half_ug) - s.nitrate);
  s.adenosine +=
      -std::expm1(-dt / m.adenosine_in_s) * (s.adenosine_ug / (s.adenosine_ug + m.adenosine_half_ug) - s.adenosine);
  step_others(m, doses, dt, s);
}

double act_s(const DrugModel& m, const DrugState& s) {
  return m.act_before_s + m.act_per_U_kg * s.heparin_U / m.weight_kg;
}

}  // namespace ostium::vascular
