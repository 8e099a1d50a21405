#include "core/model/rod.h"

#include <algorithm>
#include <stdexcept>

#include "core/base/tolerances.h"

namespace ostium::core {

namespace {

/// Sets element j, from `base_from_tip` to its distal node.
void set_element(Rod& rod, int j, double base_from_tip) {
  const SectionIntegrals element = integrate(rod.sections, rod.node_from_tip_m[j + 1], base_from_tip);
  rod.length.at(0)[j] = base_from_tip - rod.node_from_tip_m[j + 1];
  rod.rotary_inertia.at(0)[j] = element.transverse_inertia;
  rod.rotary_inertia.at(1)[j] = element.polar_inertia;
}

/// Sets the cell of node i, `from_tip` from the tip: half an element to each side that exists.
void set_cell(Rod& rod, int i, double from_tip) {
  const double towards_base = i > rod.first ? rod.length.at(0)[i - 1] / 2 : 0;
  const double towards_tip = i < rod.elements ? rod.length.at(0)[i] / 2 : 0;
  const SectionIntegrals cell = integrate(rod.sections, from_tip - towards_tip, from_tip + towards_base);
  const double length = towards_base + towards_tip;
  rod.joint_length.at(0)[i] = length;
  rod.mass.at(0)[i] = cell.mass;
  rod.rest_curvature.set(i, cell.rest_angle / length);
  std::visit([&](auto& law) { law.set_cell(i, length, cell.compliance, cell.bending); }, rod.law);
}

/// Outer radius: the largest next to a node. Bore: the smallest along an element.
void set_radii(Rod& rod) {
  for (int j = 0; j < rod.elements; ++j) {
    double radius = 0, bore = 1;
    for (const Section& s : rod.sections)
      if (s.from_tip_m < rod.node_from_tip_m[j] && s.to_tip_m > rod.node_from_tip_m[j + 1]) {
        radius = std::max(radius, s.radius_m);
        bore = std::min(bore, s.inner_radius_m);
      }
    rod.bore.at(0)[j] = bore;
    for (int i : {j, j + 1}) rod.radius.at(0)[i] = std::max(rod.radius.at(0)[i], radius);
  }
}

}  // namespace

Rod make_rod(const RodDescription& description) {
  check(description);
  const auto& lengths = description.element_lengths_m;
  const int N = static_cast<int>(lengths.size());

  Rod rod;
  rod.elements = N;
  rod.damping = description.damping;
  rod.relaxation = description.relaxation;
  rod.sections = description.sections;
  rod.length.resize(N);
  rod.rotary_inertia.resize(N);
  rod.mass.resize(N + 1);
  rod.joint_length.resize(N + 1);
  rod.rest_curvature.resize(N + 1);
  rod.bending.resize(N + 1);
  rod.radius.resize(N + 1);
  rod.bore.resize(N);
  const bool softens = std::any_of(rod.sections.begin(), rod.sections.end(),
                                   [](const Section& s) { return s.softening_per_m > 0 && s.softened_ratio < 1; });
  if (softens) rod.law = Superelastic{};
  const auto curved =
      std::find_if(rod.sections.begin(), rod.sections.end(), [](const Section& s) { return !s.bending.linear(); });
  if (curved != rod.sections.end()) rod.law = Tabulated{};
  if (rod.relaxation.any()) rod.law = Relaxing{};
  if (curved != rod.sections.end()) *curve_knots(rod.law) = knots_of(curved->bending);
  std::visit([&](auto& law) { law.resize(N + 1); }, rod.law);

  rod.node_from_tip_m.assign(N + 1, 0.0);
  for (int j = N - 1; j >= 0; --j) rod.node_from_tip_m[j] = rod.node_from_tip_m[j + 1] + lengths[j];
  rod.total_length_m = rod.node_from_tip_m[0];
  rod.total_mass_kg = integrate(rod.sections, 0, rod.total_length_m).mass;
  for (int j = 0; j < N; ++j) set_element(rod, j, rod.node_from_tip_m[j]);
  set_radii(rod);
  for (int i = 0; i <= N; ++i) {
    set_cell(rod, i, rod.node_from_tip_m[i]);
    rod.bending.at(0)[i] = stiffness_at_rest(rod, i).head<2>().maxCoeff();
    if (rod.rest_curvature[i].norm() * rod.joint_length.at(0)[i] > tolerances::max_rest_angle_rad)
      throw std::invalid_argument("rod \"" + description.name + "\": at rest it bends too sharply " +
                                  std::to_string(1e3 * rod.node_from_tip_m[i]) +
                                  " mm from the tip, by more than 2 rad from one element to the next; give it a larger "
                                  "radius (less curvature) there, or shorter elements");
  }
  return rod;
}

Eigen::Vector3d stiffness_at_rest(const Rod& rod, int joint) {
  const S3<double> C = std::visit(
      [&](const auto& law) { return law.template operator()<double>(V3<double>{}, joint).tangent; }, rod.law);
  return {C.xx, C.yy, C.zz};
}

void cut(const Rod& whole, double inserted_m, int first, Rod& inside) {
  if (inserted_m == inside.total_length_m && first == inside.first) return;
  // Restore what the last cut changed: its first element and the cells of that element's nodes.
  const int last = inside.first;
  inside.first = 0;
  if (last < whole.elements) {
    set_element(inside, last, whole.node_from_tip_m[last]);
    for (int i : {last, last + 1}) set_cell(inside, i, whole.node_from_tip_m[i]);
  }

  inside.first = first;
  inside.total_length_m = inserted_m;
  inside.total_mass_kg = integrate(whole.sections, 0, inserted_m).mass;
  if (first == whole.elements) return;
  set_element(inside, first, inserted_m);
  set_cell(inside, first, inserted_m);
  set_cell(inside, first + 1, whole.node_from_tip_m[first + 1]);
}

}  // namespace ostium::core
