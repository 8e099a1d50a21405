#pragma once
/// A generalised Maxwell solid. With e = u - u_rest the strain of a joint, branch k creeps as
///   c_k' = (e - c_k) / t_k,   and   m = law(e - f_1 c_1 - f_2 c_2),
/// Held still, the moment decays to 1 - f_1 (1 - exp(-t / t_1)) - f_2 (1 - exp(-t / t_2)) of its first value; once
/// released, the rod returns to a rest shape that has moved towards where it was held. Polymers do this (Ferry 1980,
/// Viscoelastic properties of polymers, ch. 3). `law` is the instantaneous law below.
#include "core/material/tabulated.h"

namespace ostium::core {

struct Relaxing {
  Tabulated at_once;
  Field<3> crept;  ///< 1/m, (#joints): f_1 c_1 + f_2 c_2, as the step begins (relaxation.h)

  template <class T>
  MomentResponse<T> operator()(const V3<T>& strain, int joint) const {
    return at_once(strain - load3<T>(crept, joint), joint);
  }
  /// The instantaneous, recoverable part.
  double energy(const V3<double>& strain, int joint) const {
    return at_once.energy(strain - load3<double>(crept, joint), joint);
  }

  void set_cell(int joint, double length_m, const Eigen::Vector3d& compliance, const BendingIntegrals& cell) {
    at_once.set_cell(joint, length_m, compliance, cell);
  }
  void resize(int joints) { at_once.resize(joints), crept.resize(joints); }
  void copy(const Relaxing& other, int from, int to, int joint) { at_once.copy(other.at_once, from, to, joint); }
  template <class Law>
  void copy(const Law& other, int from, int to, int joint) {
    at_once.copy(other, from, to, joint);
  }
};

}  // namespace ostium::core
