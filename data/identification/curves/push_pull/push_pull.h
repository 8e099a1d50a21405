#pragma once
/// Push and pull: the force at the hand of a wire that is fed into a path and pulled out again.
///
/// Law: a wire without weight in a tube with Coulomb's friction mu. T is its axial force, positive under compression.
/// In a bend of radius R it presses on the wall with |T| / R a length, so that towards the hand T grows by exp(mu
/// angle) under a push (capstan; Euler 1769, Eytelwein 1808), and with the stiffness of a wire in a bend with clearance
/// c around it (`channel_beam.h`). Both act together from the tip to the hand, each pressing as it would alone: T does
/// not change the shape. Friction acts against the motion: the direction of a sample is that in which `inserted_mm`
/// changed last. A force that is measured at the tip is what the law begins with there, and its noise counts as one at
/// the hand.
#include <memory>

#include "data/identification/curves/push_pull/known_walls.h"
#include "data/identification/curves/push_pull/saw_teeth.h"
#include "data/identification/curves/set/instrument_keys.h"
#include "data/identification/curves/set/set_reader.h"

namespace ostium::data::push_pull {

/// One run: in, or in and back.
struct Passage {
  std::vector<Bend> bends;  ///< from the entrance on
  double bore_radius_m = 0;
  Eigen::VectorXd inserted_m, tip_N, direction;  ///< direction: 1 in, -1 out
  Eigen::VectorXd time_s;                        ///< since the first run began; empty: unknown
  double run_before_m = 0;                       ///< distance run in and out by the wire before this run
  Eigen::VectorXd measured_N, sigma_N;           ///< at the hand, and its noise; for what only teeth before tell
  /// Samples are so close together that wall forces are computed for insertions further apart, and interpolated.
  bool between_samples = false;
};

/// Everything that an effect may change.
struct Setup {
  std::vector<Passage> runs;
  std::vector<curves::InstrumentSection> sections;  ///< from the tip on
  double radius_m = 0;                              ///< of the instrument
  double friction = 0;
  double soft_m = 0, soft_share = 1;  ///< a tip of other stiffness
  double bore_more_m = 0;             ///< radius of the bore against what is declared
  double worn_per_m = 0;              ///< growth of friction with the distance run
  double zero_N = 0, drift_N_per_s = 0;
  double sticking = 0;      ///< friction at rest against that in motion, less 1; 0: it does not stick
  double hand_N_per_m = 1;  ///< stiffness of hand and wire before it slips
  /// What is remembered of wall forces, by all copies of a setup together; so one of them at a time may be asked.
  std::shared_ptr<KnownWalls> walls = std::make_shared<KnownWalls>();
};

curves::Kind kind();

/// Forces at the hand of each run, N; of a wire that sticks, from what was measured before each sample (saw_teeth.h).
curves::Foretold hand_forces(const Setup& setup);
/// Of the slowest run.
Sticking likely_sticking(const Setup& setup);

/// Of one sample, N, with what friction alone adds to the tip's force.
double hand_force(const Setup& setup, const Passage& run, double inserted_m, double tip_N, double direction,
                  double friction);

/// Each states its law in its source file.
using Effect = curves::EffectOn<Setup>;
Effect wall_friction();
Effect soft_tip();
Effect coating_loss();
Effect clearance();
Effect stick_slip();
Effect zero_offset();
Effect force_drift();

}  // namespace ostium::data::push_pull
