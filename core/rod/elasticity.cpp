#include "core/rod/elasticity.h"

#include <algorithm>
#include <cmath>

#include "core/math/rotation.h"

namespace ostium {

namespace {

/// One joint between frames a (proximal) and b (distal).
///
/// Its strain is the rotation vector theta of R_a^T R_b over the cell's length, the mean Darboux vector. A turn phi of
/// the frames changes it by d(theta) = J^-1(theta) R_a^T (phi_b - phi_a), with the inverse left Jacobian of SO(3)
///   J^-1 = I - [theta]x / 2 + c [theta]x^2,  c = 1/12 + theta^2 / 720 + ...
/// (Sola, Deray, Atchuthan 2018, eq. 146), so the moment in the world is R_a J^-T m. Its tangent is taken at the mid
/// frame; the moment turning with the mean of both frames gives the term [m]x / 2 that `Chain` couples by.
template <class T>
struct Joint {
  S3<T> stiffness;  ///< world frame, N m/rad
  V3<T> moment;     ///< world frame, N m
  V3<T> strain;     ///< material frame, 1/m
};

template <class T, class Law>
Joint<T> joint(const Law& law, const V3<T>& rest, T length, const Q4<T>& a, Q4<T> b, int i, T damping_s, T rate_scale,
               const V3<T>& strain_offset) {
  const Q4<T> relative = conjugate(a) * b;
  const V3<T> theta = rotation_vector(relative);
  const T per_length = 1.0 / length;
  Joint<T> out;
  out.strain = per_length * theta;

  auto [m, C] = law.template operator()<T>(out.strain - rest, i);
  // Kelvin-Voigt: C (u + tau du/dt), with du/dt = rate_scale u - strain_offset (BDF2).
  m = madd(damping_s, C * (rate_scale * out.strain - strain_offset), m);
  C = madd(damping_s, rate_scale, T{} + 1.0) * C;

  const T theta2 = dot(theta, theta);
  const T c = madd(theta2, T{} + 1.0 / 720.0, T{} + 1.0 / 12.0);
  const V3<T> tm = cross(theta, m);
  out.moment = matrix(a) * (m + madd(T{} + 0.5, tm, c * cross(theta, tm)));

  const T sign = with_sign(T{} + 1.0, relative.w);  // q and -q are one rotation
  const M3<T> R =
      matrix(normalised(Q4<T>{madd(sign, b.w, a.w), madd(sign, b.x, a.x), madd(sign, b.y, a.y), madd(sign, b.z, a.z)}));
  out.stiffness = per_length * symmetric_times_transpose(R * C, R);
  return out;
}

/// Linearises joints of one rod in one step.
template <class Law>
class Joints {
 public:
  Joints(const Law& law, const Rod& rod, const RodState& state, double step_s, RodScratch& scratch)
      : law_(law), rod_(rod), state_(state), scratch_(scratch) {
    damped_ = rod.damping.material_time_s > 0 && step_s > 0;
    if (damped_) tau_ = rod.damping.material_time_s, rate_scale_ = 1.5 / step_s, offset_scale_ = 0.5 / step_s;
  }

  template <class T>
  void between(int i, const Q4<T>& a, const Q4<T>& b) {
    V3<T> offset{};
    if (damped_)
      offset = splat<T>(offset_scale_) * (splat<T>(4) * load3<T>(state_.strain, i) - load3<T>(state_.strain_before, i));
    const Joint<T> j = joint<T>(law_, load3<T>(rod_.rest_curvature, i), load<T>(rod_.joint_length.at(0) + i), a, b, i,
                                splat<T>(tau_), splat<T>(rate_scale_), offset);
    store6(scratch_.chain.joint_stiffness, i, j.stiffness);
    store3(scratch_.chain.joint_moment, i, j.moment);
    if (scratch_.strain.size() > 0) store3(scratch_.strain, i, j.strain);
  }

  void none_at(int i) {
    store6(scratch_.chain.joint_stiffness, i, S3<double>{});
    store3(scratch_.chain.joint_moment, i, V3<double>{});
    if (scratch_.strain.size() > 0) store3(scratch_.strain, i, V3<double>{});
  }

  void inner() {
    for_packs(rod_.first + 1, rod_.elements, [&]<class T>(T, int i) {
      between<T>(i, load4<T>(scratch_.orientation, i - 1), load4<T>(scratch_.orientation, i));
    });
  }

  void at_ends(EndJoints ends) {
    const int first = rod_.first, N = rod_.elements;
    none_at(first), none_at(N);
    if (ends.base) between<double>(first, state_.base.frame(), load4<double>(scratch_.orientation, first));
    if (ends.tip) between<double>(N, load4<double>(scratch_.orientation, N - 1), state_.tip.frame());
  }

 private:
  const Law& law_;
  const Rod& rod_;
  const RodState& state_;
  RodScratch& scratch_;
  bool damped_ = false;
  double tau_ = 0, rate_scale_ = 0, offset_scale_ = 0;
};

}  // namespace

[[gnu::flatten]] void linearise_joints(const Rod& rod, const RodState& state, EndJoints ends, double step_s,
                                       RodScratch& scratch) {
  std::visit(
      [&](const auto& law) {
        Joints joints(law, rod, state, step_s, scratch);
        joints.inner();
        joints.at_ends(ends);
      },
      rod.law);
}

void linearise_end_joints(const Rod& rod, const RodState& state, EndJoints ends, double step_s, RodScratch& scratch) {
  std::visit([&](const auto& law) { Joints(law, rod, state, step_s, scratch).at_ends(ends); }, rod.law);
}

double largest_joint_angle(const Rod& rod, const RodScratch& scratch) {
  Lanes packed{};
  double single = 0;  // of sin^2(angle / 2)
  for_packs(rod.first + 1, rod.elements, [&]<class T>(T, int i) {
    const Q4<T> q = conjugate(load4<T>(scratch.orientation, i - 1)) * load4<T>(scratch.orientation, i);
    const T sine2 = madd(q.x, q.x, madd(q.y, q.y, q.z * q.z));
    if constexpr (sizeof(T) == sizeof(double))
      single = largest(single, sine2);
    else
      packed = largest(packed, sine2);
  });
  return 2 * std::asin(std::sqrt(std::min(1.0, largest(single, horizontal_max(packed)))));
}

[[gnu::flatten]] void assemble_elements(const Rod& rod, RodScratch& scratch) {
  Chain& chain = scratch.chain;
  chain.first = rod.first, chain.elements = rod.elements;
  const double with_force = scratch.geometric == GeometricStiffness::with ? 1 : 0;
  for_packs(rod.first, rod.elements, [&]<class T>(T, int j) {
    const T length = load<T>(rod.length.at(0) + j);
    const V3<T> d3 = director3(load4<T>(scratch.orientation, j));
    const V3<T> n = splat<T>(with_force) * load3<T>(scratch.force, j);

    // Geometric stiffness, the second variation of -n . l d3: l ((n . d3) I - (n d3^T + d3 n^T) / 2).
    const T tension = length * dot(n, d3), half = -0.5 * length;
    const S3<T> force_stiffness{madd(half, 2.0 * n.x * d3.x, tension), half * madd(n.x, d3.y, n.y * d3.x),
                                half * madd(n.x, d3.z, n.z * d3.x),    madd(half, 2.0 * n.y * d3.y, tension),
                                half * madd(n.y, d3.z, n.z * d3.y),    madd(half, 2.0 * n.z * d3.z, tension)};
    store6(chain.stiffness, j,
           load6<T>(chain.joint_stiffness, j) + load6<T>(chain.joint_stiffness, j + 1) + force_stiffness);
    store3(chain.torque, j, load3<T>(chain.joint_moment, j + 1) - load3<T>(chain.joint_moment, j));
    store3(chain.arm, j, length * d3);
    store3(chain.gap, j, load3<T>(scratch.target, j) - load3<T>(scratch.target, j + 1) + length * d3);
  });
  if (scratch.geometric == GeometricStiffness::without)
    for_packs(rod.first, rod.nodes(), [&]<class T>(T, int i) { store3(chain.joint_moment, i, V3<T>{}); });
}

}  // namespace ostium