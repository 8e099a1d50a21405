#include "data/identification/selection/evidence.h"

#include <algorithm>
#include <cmath>

#include "data/identification/residuals/noise_model.h"

namespace ostium::data {

namespace {

constexpr double clearly = 0.95;  // relative to another model's held-out error

}  // namespace

bool at_an_edge(const FittedModel& model) {
  return std::any_of(model.parameters.begin(), model.parameters.end(), [](const FittedParameter& p) {
    const Parameter& q = p.parameter;
    if (q.name.starts_with("EI_scale") || q.name.starts_with("registration.") || q.name.starts_with("tip_offset."))
      return false;
    const bool low = q.logarithmic ? p.value < q.least * 1.01 : p.value < q.least + 1e-3 * (q.most - q.least);
    const bool high = q.logarithmic ? p.value > q.most * 0.99 : p.value > q.most - 1e-3 * (q.most - q.least);
    // A zero limit of a positive parameter is no edge: it means that the effect is absent.
    return high || (low && q.least != 0);
  });
}

bool predicts_better(const FittedModel& a, const FittedModel& b) {
  if (!a.rms_held_out_m || !b.rms_held_out_m) return false;
  const double shapes = *a.rms_held_out_m / *b.rms_held_out_m;
  const bool pushes =
      a.push_rms_held_out_N && b.push_rms_held_out_N && *a.push_rms_held_out_N < clearly * *b.push_rms_held_out_N;
  return shapes < clearly || (pushes && shapes < 1 / clearly);
}

bool wins(const FittedModel& candidate, const FittedModel& declared, const Noise& noise) {
  if (!predicts_better(candidate, declared) || candidate.bic > declared.bic - strong_evidence) return false;
  return !noise.sigma_m || is_noise(candidate, noise);
}

bool is_noise(const FittedModel& model, const Noise& noise) {
  if (noise.sigma_m) {
    // Four standard deviations of chi2 per degree of freedom; an estimated noise is itself uncertain by some per cent.
    const double allowed = 1 + 4 * std::sqrt(2 / model.degrees_of_freedom) + (noise.declared ? 0 : 0.15);
    if (*model.chi2_per_dof > allowed) return false;
    // What is far below the noise that is declared has a shape, but is no misfit: a unit is wrong, which is said.
    if (noise.declared && !doubt_of_noise(*model.chi2_per_dof, model.degrees_of_freedom).empty()) return true;
  }
  if (model.correlation && model.correlation->standard_errors > 4) return false;
  return !has_pattern(model);
}

bool has_pattern(const FittedModel& model) {
  return std::any_of(model.residual_tests.list.begin(), model.residual_tests.list.end(),
                     [](const ResidualTest& d) { return d.significant; });
}

double own_noise_bic(const MeasurementSet& set, const FittedModel& model) {
  const std::vector<ResidualTrace> traces = traces_of(set, model.misfits);
  const NoiseModel own = noise_model_of(traces, set.imaging.noise_sigma_m);
  return own_noise_cost(traces, set.imaging.noise_sigma_m) +
         model.parameters_used * std::log(effective_numbers(traces, own));
}

bool has_law(const FittedModel& model) { return std::any_of(model.effects.begin(), model.effects.end(), is_law); }

Misfit misfit_of(const FittedModel& model) {
  return {model.chi2_per_dof.value_or(0) * model.degrees_of_freedom, model.degrees_of_freedom};
}

}  // namespace ostium::data
