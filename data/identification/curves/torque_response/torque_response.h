#pragma once
/// Torque response: the angle at the distal end and the torque at the drive, against the angle at the drive, in a path.
///
/// Law: the wire is a chain of torsion springs (GJ over length) between its contacts with the wall, where Coulomb's
/// friction resists with at most mu N r. It is turned so slowly that it is at rest: each contact stands while the
/// springs on both sides pull with less, and slips until they pull with just that (play elements in a row; Visintin
/// 1994, Differential Models of Hysteresis). The part beyond the last contact is free and turns with it.
///
/// A wire that is turned back lets its twist go at once, and how far contacts slip then depends on inertia and on
/// friction at rest, which this law lacks. So samples within that stretch (four times the lag, which is twice the turn
/// that the law needs, if its lag is wrong by half) count with a standard deviation of half the lag.
#include "data/identification/curves/set/set_reader.h"

namespace ostium::data::torque_response {

/// Places are from the drive.
struct Contact {
  double at_m = 0, force_N = 0;
};

struct Bend {
  double at_m = 0, length_m = 0, radius_m = 0;
  double plane_rad = 0;  ///< how far the plane in which it bends is turned about the wire
};

/// One run: a wire turned in a path, from rest.
struct Turning {
  std::vector<Contact> contacts;  ///< from the drive on
  std::vector<Bend> bends;
  Eigen::VectorXd proximal_rad;
  double distal_more_rad = 0;  ///< what the distal scale shows too much
};

struct Section {
  double from_m = 0, to_m = 0;  ///< from the drive
  double GJ_N_m2 = 0, EI_N_m2 = 0;
};

/// Everything that an effect may change.
struct Setup {
  std::vector<Turning> runs;
  std::vector<Section> sections;
  double radius_m = 0;       ///< of the instrument
  double friction = 0;       ///< at the contacts
  double rest_per_m[2]{};    ///< curvature of the free wire: towards its mark, and a quarter turn from there
  double handed = 1;         ///< GJ under positive torque against that under negative
  double slip = 0;           ///< share of the drive's turn that does not arrive
  double dead_rad = 0;       ///< the drive's dead band
  double dead_at_start = 0;  ///< share of it that is still to be taken up when a run begins, 0 to 1
};

curves::Kind kind();

/// Distal angle, degrees, and torque at the drive, N mm, of each run.
std::vector<curves::Curves> responses(const Setup& setup);

/// Each states its law in its source file.
using Effect = curves::EffectOn<Setup>;
Effect wall_friction();
Effect whip();
Effect handed_stiffness();
Effect drive_slip();
Effect drive_backlash();
/// From run `from` on.
Effect reseated_instrument(std::size_t from, const std::string& id);

}  // namespace ostium::data::torque_response
