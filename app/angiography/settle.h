#pragma once
#include "vascular/physiology/physiology.h"

namespace ostium::app {

/// The circulation once pressure and flow repeat from beat to beat, at phase 0.
inline vascular::PhysiologyState at_rest(const vascular::PhysiologyModel& model, double rate_1_min,
                                         double seconds = 20) {
  vascular::PhysiologyState state = make_state(model);
  vascular::PhysiologyScratch scratch;
  vascular::PhysiologyInputs inputs;
  inputs.heart.rate_1_min = rate_1_min;
  double before = 0;
  for (int n = 0; n < 1000 * seconds || before < state.heart.phase; ++n) {
    before = state.heart.phase;
    step(model, inputs, 1e-3, state, scratch);
  }
  settle_reflex(state.heart.circulation);
  return state;
}

}  // namespace ostium::app
