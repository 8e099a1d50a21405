#pragma once
#include <cmath>

#include "vascular/heart/heart.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::vascular {

/// A person who lies still: a heart by itself, with reflexes or without.
struct Person {
  HeartModel model;
  HeartState state;
  HeartInputs inputs;
  double breaths_1_min = 0;

  explicit Person(bool reflexes) {
    run(30);
    settle_reflex(state.circulation);
    inputs.body.reflexes = reflexes;
  }
  void step() {
    if (breaths_1_min > 0) inputs.body.breath = breath_depth(std::fmod(breaths_1_min / 60 * state.time_s, 1.0));
    vascular::step(model, inputs, 1e-3, state);
  }
  void run(double seconds) {
    for (int n = 0; n < 1000 * seconds; ++n) step();
  }
  void leak(double volume_m3, double m3_s = 1e-6) {
    inputs.body.leak_m3_s = m3_s;
    run(volume_m3 / m3_s);
    inputs.body.leak_m3_s = 0;
  }
  void drain(double volume_m3, double m3_s = 5e-6) {
    inputs.body.drain_m3_s = m3_s;
    run(volume_m3 / m3_s);
    inputs.body.drain_m3_s = 0;
  }
};

}  // namespace ostium::vascular
