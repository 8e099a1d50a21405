#pragma once
/// Instruments driven through a vessel by a script and at random, and how far they penetrate the wall: for the contact
/// gates, the soak test and the benchmark.
#include <cstdint>

#include "app/gates/test_vessel.h"
#include "core/contact/penetration_oracle.h"
#include "core/step/step.h"
#include "data/assessment/gate_report.h"

namespace ostium::app::gates {

/// A catalogue guide catheter and coronary wire in the test vessel, or the wire alone.
class Rehearsal {
 public:
  Rehearsal(const TestVessel& vessel, bool with_guide, bool sweep = true);

  /// Places the wire along a path into a branch, with `inserted_m` in the vessel, and lets it come to rest while the
  /// vessel does not move.
  void lay_wire(const std::vector<Eigen::Vector3d>& way_W, double inserted_m);

  /// One step at that heart rate, 1/min.
  void step(double beats_per_min);

  int wire() const { return static_cast<int>(model.rods.size()) - 1; }

  core::Model model;
  core::State state;
  core::Scratch scratch;
  core::Inputs inputs;
  core::StepReport report;
  double frame = 0;  ///< in the vessel's cycle, after the last step

 private:
  void settle();
};

struct Holding {
  double deepest_m = 0;  ///< deepest penetration of a node's sphere into the wall
  int escapes = 0;       ///< nodes whose centre was outside
  long troubled = 0;     ///< steps with trouble flags other than a stopped feed
};

/// Measures the penetration of all nodes; `winding`: also tests whether nodes near the wall are inside.
void judge(const Rehearsal& run, core::PenetrationOracle& judge, bool winding, Holding& holding);

/// Inputs at `t_s` of the scripted procedure: wire and guide advanced at 5 cm/s, turned, drawn back and advanced again,
/// every 24 s. The wire leads, and goes on into a branch.
void follow_script(double t_s, Rehearsal& run);

/// The scripted procedure at a heart rate.
Holding scripted_procedure(const TestVessel& vessel, double beats_per_min, double seconds);

/// One random drive: speeds up to 20 cm/s and 10 turns/s, redrawn every 0.1 to 1 s, 60 to 180 beats/min; with an odd
/// seed it starts with the wire in a branch.
Holding random_drive(const TestVessel& vessel, std::uint64_t seed, double seconds, bool sweep = true);

/// The contact gates in the test vessel: the scripted procedure and random drives.
std::vector<data::GateResult> contact_in_vessel(bool quick);

}  // namespace ostium::app::gates
