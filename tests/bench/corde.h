#pragma once
/// Reference implementation: the published explicit CoRdE rod (Spillmann and Teschner, Proc. SCA 2007, pp. 63-72) with
/// the distance constraints of Korzeniowski (PhD thesis, Imperial College London, 2015, chapter 3), reimplemented from
/// the equations. Used by the benchmark only; nothing in Ostium builds on this model. Equation numbers are the
/// thesis's.
///
/// n elements join n + 1 mass points r_i; each element carries a unit quaternion q_j whose third director d3 is aligned
/// with the tangent by a penalty spring (eq. 8). Point 0 is clamped, and so is a frame at s = 0, half an element before
/// the first: the rod starts straight along +x, at rest, with d3 = x and d1 = -z.
///
/// Where the sources leave a choice, it favours the model:
/// - Second moments of area are pi r^4 / 4 and pi r^4 / 2; below eq. 3 stands r^2, which lacks the unit of a stiffness.
/// - The frames are integrated as rigid bodies; by default an element has the rotational inertia of a cylinder of its
/// length, m (3 r^2 + l^2) / 12. That of the cross-section alone, m r^2 / 4, makes the frames so light that their own
/// oscillation limits the step: 1.7 times shorter at 512 elements.
/// - The Baumgarte constant k_s is a fraction of the error per step (k_s C / h in eq. 17), as in engines of its time.
/// - Friction and natural curvature are computed only if asked for: both would only make a step more expensive.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace ostium::bench {

/// How the rod's length is preserved.
enum class Stretch {
  global,   ///< '1G': all distance constraints at once, a tridiagonal system (eq. 17)
  local,    ///< 'nL': n Gauss-Seidel sweeps over eq. 17, clamp to tip, started from zero in every step
  penalty,  ///< '1I': the internal stretch energy of eq. 2
};
/// Inertia of an element about d1 and d2; about d3 it is m r^2 / 2 in both.
enum class FrameInertia { cylinder, cross_section };

/// Defaults: the steel-like test rod of the rod gates.
struct CordeSettings {
  int elements = 512;            ///< n >= 3
  double length_m = 1.0;         ///< at rest
  double radius_m = 0.45e-3;     ///< of the round, solid cross-section
  double E_Pa = 60e9, nu = 0.3;  ///< Young's modulus, Poisson's ratio
  double density_kg_m3 = 6500.0;
  Eigen::Vector3d gravity_m_s2{0.0, 0.0, -9.81};
  double step_s = 1e-6;  ///< h
  /// K_p of eq. 8, N: effectively a shear stiffness (a frame deviates from the tangent by shear force / K_p). Zero: the
  /// value of `free_alignment_spring`.
  double alignment_N = 0.0;
  FrameInertia inertia = FrameInertia::cylinder;
  Stretch stretch = Stretch::global;
  int local_sweeps = 1;         ///< of Stretch::local
  double k_s = 0.1, k_d = 1.0;  ///< Baumgarte and mixing factors, 0..1 (thesis, section 3.2.2)
  double stretch_Pa = 0.0;      ///< E_s of eq. 2, Stretch::penalty only
  /// CoRdE's internal friction: gamma_t, tension per rate of strain; gamma_r, moment per rate of curvature or twist.
  double stretch_friction_N_s = 0.0, rotation_friction_N_m2_s = 0.0;
};

class Corde {
 public:
  explicit Corde(const CordeSettings&);

  /// One semi-implicit Euler step of `step_s`, in the order of table 3.1. Allocates nothing.
  void step();

  const CordeSettings& settings() const { return settings_; }
  int points() const { return settings_.elements + 1; }
  Eigen::Vector3d position(int point) const { return {x_[point], y_[point], z_[point]}; }
  Eigen::Vector3d tip() const { return position(settings_.elements); }
  Eigen::Quaterniond frame(int element) const;
  /// (Sum of element lengths / rest length - 1) * 100.
  double stretch_percent() const;
  /// Largest angle between an element's d3 and its tangent, rad: the residual of eq. 7.
  double misalignment() const;
  /// Kinetic, elastic, alignment and gravitational energy, J; zero for the straight rod at rest.
  double energy_J() const;
  /// Moment in the joint before `element` (0: the clamp's), N m, in material axes (d1, d2, d3).
  Eigen::Vector3d moment_N_m(int element) const;

  /// Set pose and velocity, for tests.
  void set_frame(int element, const Eigen::Quaterniond&);
  /// Angular velocity, rad/s, in material axes.
  void set_spin(int element, const Eigen::Vector3d& omega);

 private:
  void measure_elements();
  void align_frames();
  void bend_joints();
  void pull_elements();
  void rub_joints();
  void integrate_forces();
  void solve_distances_globally();
  void solve_distances_locally();
  void integrate_velocities();

  CordeSettings settings_;
  double l_, K1_, K3_, Kp_, J1_, J3_;  ///< element length, EI, GJ, K_p, inertia of an element about d1 and d3

  using Column = std::vector<double>;    // one component of a field; n + 1 long, of which elements use n
  Column x_, y_, z_, vx_, vy_, vz_, w_;  // points: position, velocity, inverse mass (0: clamped)
  Column qw_, qx_, qy_, qz_;             // frames: 0 the clamp's, j + 1 element j's
  Column o1_, o2_, o3_;                  // their angular velocities, along d1, d2, d3
  Column length_, tx_, ty_, tz_;         // elements: |r_{i+1} - r_i|, tangent
  Column fx_, fy_, fz_;                  // elements: force on the far point, opposite on the near one
  Column left1_, left2_, left3_, right1_, right2_, right3_;  // joints: torque on the frame before, behind
  Column diagonal_, off_, lambda_;                           // distance constraints: J W J^T, impulses
};

/// The largest K_p that does not limit the step: the fastest frame mode is at most 5 % faster with it. At real
/// stiffness and 512 elements it is 3,000 N, a fifth of the rod's true shear stiffness GA: the frames deviate from the
/// tangent by 1e-5 rad per 0.03 N of shear (the rod weighs 0.04 N).
double free_alignment_spring(const CordeSettings&);

/// Whether the rod, released from the horizontal with every frame disturbed by 1e-3 rad/s, keeps its energy for
/// `trial_s` (at least 2,000 steps). Gravity must not be zero.
bool is_stable(CordeSettings, double step_s, double trial_s);
/// The largest stable step, s, by bisection to 0.5 %. 20 ms suffice to reveal growing modes; the step found at 512
/// elements was run for 3 s.
double largest_stable_step(const CordeSettings&, double trial_s = 0.02);

/// CPU time of this thread per simulated millisecond at `step_s`, ms: the mean over `simulated_s`, after a warm-up.
double cpu_ms_per_simulated_ms(const CordeSettings&, double simulated_s = 0.02);

/// The rod of the stretch experiment (thesis, fig. 3.6), stable at 1, 2.5 and 5 ms and up to 1,024 elements: elements
/// of 1 m (more elements make a longer rod, as in the thesis), radius 0.25 m, E 60 MPa (a thousandth of real), 1,000
/// kg/m3, nu 0.3, gamma_r 100 N m2 s, E_s 0.8 rho l^2 / h^2 (the highest that is stable in all cases). These are no
/// instrument's values. The length of 1 m is forced: an explicit chain swings stably only for n g h^2 / l below about a
/// third, and every stretch in that figure is a multiple of the same number (1L 10 to 25 times it, 1I a sixth of that).
CordeSettings soft_rod(int elements, double step_s, Stretch, int local_sweeps = 1);
/// 3 sqrt(L / g), s: from the horizontal down and past the vertical, short of the first crack of the free end.
double swing_s(const CordeSettings&);
/// Largest |stretch_percent()| while the rod, released from the horizontal, swings for `duration_s`; infinity if it
/// becomes unstable.
double stretch_percent(const CordeSettings&, double duration_s);

}  // namespace ostium::bench
