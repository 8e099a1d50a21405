#include "core/rod/elasticity.h"

#include <algorithm>
#include <cmath>

#include "core/math/rotation.h"
#include "core/rod/joint.h"

namespace ostium::core {

namespace {

/// Linearises the joints of one rod.
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
  BlockTridiagonal& chain = scratch.chain;
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

}  // namespace ostium::core