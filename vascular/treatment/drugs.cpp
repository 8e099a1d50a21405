#include "vascular/treatment/drugs.h"

#include <algorithm>
#include <cmath>

namespace ostium::vascular {

void step(const DrugModel& m, const Doses& doses, double dt, DrugState& s) {
  const auto given = [](double dose) { return dose > 0 && std::isfinite(dose) ? dose : 0; };
  s.heparin_U = (s.heparin_U + given(doses.heparin_U)) * std::exp2(-dt / m.heparin_half_life_s);
  s.nitrate_ug = (s.nitrate_ug + given(doses.nitrate_ug)) * std::exp(-dt / m.nitrate_out_s);
  s.adenosine_ug = (s.adenosine_ug + given(doses.adenosine_ug)) * std::exp(-dt / m.adenosine_out_s);
  s.nitrate += -std::expm1(-dt / m.nitrate_in_s) * (s.nitrate_ug / (s.nitrate_ug + m.nitrate_half_ug) - s.nitrate);
  s.adenosine +=
      -std::expm1(-dt / m.adenosine_in_s) * (s.adenosine_ug / (s.adenosine_ug + m.adenosine_half_ug) - s.adenosine);
}

double act_s(const DrugModel& m, const DrugState& s) {
  return m.act_before_s + m.act_per_U_kg * s.heparin_U / m.weight_kg;
}

}  // namespace ostium::vascular
