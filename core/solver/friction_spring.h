#pragma once
/// Coulomb friction at one contact point, static and kinetic, as a spring that slips.
///
/// The slip z (m, along and around the instrument) is the elastic displacement of the point. In a step it grows by the
/// sliding of the surfaces, and the force is -k z. With
///   k = mu N / max(give, |expected z|)
/// this is a stiff spring while the point sticks, and mu N against the sliding once the expected slip exceeds `give`;
/// the excess is then discarded. k is known before the solve, so friction is linear in the solve and can only dissipate
/// (a return map: Simo, Hughes 1998, ch. 1).
#include <cmath>

namespace ostium::core {

struct Slip {
  double along = 0, around = 0;  ///< m

  double size() const { return std::sqrt(along * along + around * around); }
};

/// k, N/m; `trial`: slip expected at the end of the step.
inline double slip_stiffness(double friction, double normal_N, double give_m, const Slip& trial) {
  const double size = trial.size();
  return friction * normal_N / (size > give_m ? size : give_m);
}

/// The part of a slip that is kept for the next step.
inline Slip kept(const Slip& slip, double give_m) {
  const double size = slip.size();
  if (!(size > give_m)) return slip;
  return {give_m / size * slip.along, give_m / size * slip.around};
}

}  // namespace ostium::core
