#include "core/rod/rod.h"

#include <algorithm>
#include <numeric>

namespace ostium {

namespace {

/// Integrals over a stretch of the rod, a <= distance from the tip <= b.
struct Integrals {
  double mass = 0, transverse_inertia = 0, polar_inertia = 0;
  Eigen::Vector3d compliance = Eigen::Vector3d::Zero();  ///< of (1/EI1, 1/EI2, 1/GJ)
  Eigen::Vector3d rest_angle = Eigen::Vector3d::Zero();  ///< of the rest curvature
};

Integrals integrate(const std::vector<Section>& sections, double a, double b) {
  Integrals sum;
  for (const Section& s : sections) {
    // The outermost section reaches as far as asked for: the check has allowed for rounding only.
    const double end = &s == &sections.back() ? std::max(s.to_tip_m, b) : s.to_tip_m;
    const double length = std::min(b, end) - std::max(a, s.from_tip_m);
    if (length <= 0) continue;
    // Second moment of a round section about a diameter, per unit of area: (ro^2 + ri^2) / 4.
    const double gyration2 = (s.radius_m * s.radius_m + s.inner_radius_m * s.inner_radius_m) / 4;
    sum.mass += length * s.kg_per_m;
    sum.transverse_inertia += length * s.kg_per_m * gyration2;
    sum.polar_inertia += length * s.kg_per_m * gyration2 * 2;
    sum.compliance += length * Eigen::Vector3d(1 / s.EI1_N_m2, 1 / s.EI2_N_m2, 1 / s.GJ_N_m2);
    sum.rest_angle += length * s.rest_curvature_per_m;
  }
  return sum;
}

}  // namespace

Rod make_rod(const RodDescription& description) {
  check(description);
  const auto& lengths = description.element_lengths_m;
  const auto& sections = description.sections;
  const int N = static_cast<int>(lengths.size());

  Rod rod;
  rod.elements = N;
  rod.damping = description.damping;
  rod.length.resize(N);
  rod.rotary_inertia.resize(N);
  rod.mass.resize(N + 1);
  rod.joint_length.resize(N + 1);
  rod.rest_curvature.resize(N + 1);
  LinearElastic law;
  law.stiffness.resize(N + 1);
  // Padding must not divide by zero.
  std::fill(rod.joint_length.raw().begin(), rod.joint_length.raw().end(), 1.0);

  rod.total_length_m = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  std::vector<double> node_from_tip(N + 1);
  node_from_tip[N] = 0;
  for (int j = N - 1; j >= 0; --j) node_from_tip[j] = node_from_tip[j + 1] + lengths[j];

  for (int j = 0; j < N; ++j) {
    const Integrals element = integrate(sections, node_from_tip[j + 1], node_from_tip[j]);
    rod.length.at(0)[j] = lengths[j];
    rod.rotary_inertia.at(0)[j] = element.transverse_inertia;
    rod.rotary_inertia.at(1)[j] = element.polar_inertia;
    rod.total_mass_kg += element.mass;
  }
  for (int i = 0; i <= N; ++i) {
    const double towards_base = i > 0 ? lengths[i - 1] / 2 : 0, towards_tip = i < N ? lengths[i] / 2 : 0;
    const Integrals cell = integrate(sections, node_from_tip[i] - towards_tip, node_from_tip[i] + towards_base);
    const double length = towards_base + towards_tip;
    rod.joint_length.at(0)[i] = length;
    rod.mass.at(0)[i] = cell.mass;
    rod.rest_curvature.set(i, cell.rest_angle / length);
    law.stiffness.set(i, length * cell.compliance.cwiseInverse());
  }
  rod.law = std::move(law);
  return rod;
}

}  // namespace ostium
