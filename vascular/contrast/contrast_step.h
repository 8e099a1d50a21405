#pragma once
/// The parts of one contrast step, in the order of execution.
#include <cmath>

#include "vascular/contrast/contrast.h"

namespace ostium::vascular {

inline constexpr double least_m3 = 1e-13;  // of a cell

struct ContrastStep {
  const ContrastModel& model;
  const BloodNow& now;
  const ContrastInputs& in;
  double dt;
  ContrastState& s;
  ContrastScratch& x;
  ContrastReport report{};
  double mixing_now = -std::expm1(-dt / model.mixing_s);

  std::size_t n() const { return now.flow.tree.cells.size(); }
  double volume(int c) const { return x.cell_m3[c]; }
  int root(int side) const {
    const int b = model.coronary_branch[side];
    return b < 0 ? -1 : now.flow.tree.branches[b].first;
  }
  /// Volume through a cell's upstream face in this step, without what a catheter adds there.
  double through(int c) const { return std::max(0.0, now.state.flow_m3_s[c] * dt - x.entering[c]); }
  double sinus_kg_m3(int side) const { return s.sinus_kg[side] / model.sinus_m3; }

  /// Free volume of each cell.
  void measure();
  /// Adds the injection: into the coronary (x.entering, m3 and kg) and outside it.
  void inject();
  void aspirate();
  /// A balloon that fills a cell displaces its contents towards the heart.
  void push_out_excess();
  void run_branch(int b);
  /// Mixing of the sheaths; outflow to side branches and myocardium.
  void leave(int c);
  /// Dispersion by cardiac motion between neighbouring cells of a branch.
  void disperse();
  void run_aorta();
};

}  // namespace ostium::vascular
