#pragma once
/// One coronary artery with a branch, its heart and blood, for tests that run them.
#include "core/base/units.h"
#include "vascular/physiology/physiology.h"

namespace ostium::vascular {

/// A right coronary artery of 100 mm with one branch half-way.
inline PhysiologyModel model_of(const std::vector<PlainBranch>& branches = {{-1, 50, 1e-3, 1.6e-3, Territory::rca},
                                                                            {0, 50, 1e-3, 1.3e-3, Territory::rca},
                                                                            {0, 40, 1e-3, 0.9e-3, Territory::rca}}) {
  PhysiologyModel model{.heart = {},
                        .ischaemia = {},
                        .flow = make_flow_model(plain_tree(branches), 90 * units::mL_min),
                        .contrast = {},
                        .line = {}};
  model.contrast = make_contrast_model(model.flow);
  return model;
}

struct Body {
  PhysiologyModel model = model_of();
  PhysiologyState state = make_state(model);
  PhysiologyInputs inputs;
  PhysiologyScratch scratch;

  ContrastReport run(double seconds) {
    ContrastReport last;
    for (int n = 0; n < 1000 * seconds; ++n)
      if (const ContrastReport r = step(model, inputs, 1e-3, state, scratch); r.rate_m3_s > 0 || r.refused) last = r;
    return last;
  }
  /// Mean over complete beats.
  double flow(int cell, int beats = 5) {
    double sum = 0;
    int steps = 0;
    for (int left = beats; left > 0; ++steps) {
      const double before = state.heart.phase;
      step(model, inputs, 1e-3, state, scratch);
      sum += state.flow.flow_m3_s[cell];
      left -= state.heart.phase < before;
    }
    return sum / steps;
  }
  void narrow(int from, int to, double stenosis) {
    for (int c = from; c < to; ++c) state.radius_m[c] = (1 - stenosis) * model.flow.tree.cells[c].healthy_m;
  }
};

}  // namespace ostium::vascular
