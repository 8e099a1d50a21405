#pragma once
/// One step of contrast: its parts in the order in which it meets them.
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
  /// Volume that passes a cell's upstream face in this step, but for what a catheter adds there.
  double through(int c) const { return std::max(0.0, now.state.flow_m3_s[c] * dt - x.entering[c]); }
  double sinus_kg_m3(int side) const { return s.sinus_kg[side] / model.sinus_m3; }

  /// Free volume of each cell.
  void measure();
  /// What the catheter gives, to the coronary (x.entering, m3 and kg) and beside it.
  void inject();
  void aspirate();
  /// A balloon that fills a cell pushes out what was in it, towards the heart.
  void push_out_excess();
  void run_branch(int b);
  /// Sheaths mix, side branches and muscle take theirs.
  void leave(int c);
  /// The beat's to and fro, between neighbours of a branch.
  void disperse();
  void run_aorta();
};

}  // namespace ostium::vascular
