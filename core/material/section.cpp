#include "core/material/section.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "core/base/units.h"

namespace ostium::core {

namespace {

/// A number as a person writes it: 1.00000005, not 1.000000.
std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.9g", value);
  return buffer;
}

[[noreturn]] void refuse(const RodDescription& d, std::size_t section, const std::string& what) {
  throw std::invalid_argument("rod \"" + d.name + "\", section " + std::to_string(section) + ": " + what);
}

/// Limits far outside any real instrument and inside what the arithmetic can handle.
void require_between(const RodDescription& d, std::size_t section, const char* name, double value, double least,
                     double most, const char* unit) {
  if (!(value >= least && value <= most))
    refuse(d, section,
           std::string(name) + " is " + text(value) + " " + unit + "; it must be positive and finite, between " +
               text(least) + " and " + text(most));
}

/// A section's moment-curvature curve.
void check_curve(const RodDescription& d, std::size_t section) {
  const Section& s = d.sections[section];
  const BendingCurve& curve = s.bending;
  if (curve.linear()) return;
  if (curve.knots < 0 || curve.knots > BendingCurve::most)
    refuse(d, section,
           "its moment-curvature curve has " + std::to_string(curve.knots) + " knots; at most " +
               std::to_string(BendingCurve::most) + " are possible");
  if (s.softening_per_m > 0 && s.softened_ratio < 1)
    refuse(d, section, "has both a softening and a moment-curvature curve; give one of them");
  double before = 0;
  for (int j = 0; j < curve.knots; ++j) {
    if (!(curve.curvature_per_m[j] >= before + 1e-6 && curve.curvature_per_m[j] <= 1e6))
      refuse(d, section, "the curvatures of its moment-curvature curve must rise from above 0 to 1e6 1/m at most");
    require_between(d, section, "tangent against EI", curve.tangent[j], 0.01, 100, "");
    before = curve.curvature_per_m[j];
  }
  const auto first =
      std::find_if(d.sections.begin(), d.sections.end(), [](const Section& other) { return !other.bending.linear(); });
  if (first->bending.knots != curve.knots || first->bending.curvature_per_m != curve.curvature_per_m)
    refuse(d, section, "its moment-curvature curve has other curvatures than another section's; give all the same");
}

}  // namespace

std::vector<double> equal_elements(const std::vector<Section>& sections, int count) {
  const double length = sections.empty() ? 0 : sections.back().to_tip_m;
  return std::vector<double>(count, length / count);
}

Section round_section(double from_tip_m, double to_tip_m, double radius_m, double inner_radius_m, double E_Pa,
                      double nu, double kg_per_m3) {
  const double fourth = std::pow(radius_m, 4) - std::pow(inner_radius_m, 4);
  const double area = units::pi * (radius_m * radius_m - inner_radius_m * inner_radius_m);
  Section s;
  s.from_tip_m = from_tip_m, s.to_tip_m = to_tip_m;
  s.EI1_N_m2 = s.EI2_N_m2 = E_Pa * units::pi / 4 * fourth;
  s.GJ_N_m2 = E_Pa / (2 * (1 + nu)) * units::pi / 2 * fourth;
  s.kg_per_m = kg_per_m3 * area;
  s.radius_m = radius_m, s.inner_radius_m = inner_radius_m;
  return s;
}

void check(const RodDescription& d) {
  constexpr double gap_tolerance_m = 1e-9;
  if (d.sections.empty()) throw std::invalid_argument("rod \"" + d.name + "\" has no section; give at least one");
  double reached = 0;
  for (std::size_t i = 0; i < d.sections.size(); ++i) {
    const Section& s = d.sections[i];
    if (!(s.to_tip_m > s.from_tip_m))
      refuse(d, i,
             "reaches from " + text(s.from_tip_m) + " m to " + text(s.to_tip_m) +
                 " m from the tip; its length must be positive");
    if (std::fabs(s.from_tip_m - reached) > gap_tolerance_m)
      refuse(d, i,
             "begins " + text(s.from_tip_m) + " m from the tip, but the one before it ends at " + text(reached) +
                 " m; sections run from the tip backwards without gap or overlap");
    require_between(d, i, "EI1", s.EI1_N_m2, 1e-12, 1e3, "N m2");
    require_between(d, i, "EI2", s.EI2_N_m2, 1e-12, 1e3, "N m2");
    require_between(d, i, "GJ", s.GJ_N_m2, 1e-12, 1e3, "N m2");
    require_between(d, i, "weight per length", s.kg_per_m, 1e-9, 1e3, "kg/m");
    require_between(d, i, "radius", s.radius_m, 1e-6, 0.1, "m");
    if (!(s.inner_radius_m >= 0 && s.inner_radius_m < s.radius_m))
      refuse(d, i, "inner radius is " + text(s.inner_radius_m) + " m; it must lie between 0 and the outer radius");
    const double curled = s.rest_curvature_per_m.norm();
    if (!(curled * s.radius_m < 1))
      refuse(d, i,
             "rest curvature is " + text(curled) + " 1/m; it must be below " + text(1 / s.radius_m) +
                 ", one by the outer radius");
    if (!(s.softening_per_m == 0 || (s.softening_per_m >= 1e-3 && s.softening_per_m <= 1e6)))
      refuse(d, i, "softens at " + text(s.softening_per_m) + " 1/m; it must be 0 or between 0.001 and 1e6");
    if (!(s.softened_ratio >= 0.01 && s.softened_ratio <= 1))
      refuse(d, i, "softens to " + text(s.softened_ratio) + " of its stiffness; it must lie between 0.01 and 1");
    check_curve(d, i);
    reached = s.to_tip_m;
  }
  const auto in_name = [&](const std::string& what) {
    return std::invalid_argument("rod \"" + d.name + "\": " + what);
  };
  if (d.element_lengths_m.size() < least_elements || d.element_lengths_m.size() > most_elements)
    throw in_name(std::to_string(d.element_lengths_m.size()) + " elements; " + std::to_string(least_elements) + " to " +
                  std::to_string(most_elements) + " are possible");
  double total = 0;
  for (double length : d.element_lengths_m) {
    if (!(length > 0) || !std::isfinite(length)) throw in_name("an element's length must be positive and finite");
    total += length;
  }
  if (total > reached * (1 + 1e-12) + gap_tolerance_m)
    throw in_name("its elements are " + text(total) + " m long together, its sections only " + text(reached));
  const Damping& loss = d.damping;
  for (double value : {loss.drag_across_N_s_m2, loss.drag_along_N_s_m2, loss.material_time_s})
    if (!(value >= 0 && value <= 1e6)) throw in_name("damping is " + text(value) + "; it must lie between 0 and 1e6");
  const auto& [fast, slow] = d.relaxation.branches;
  for (const Relaxation::Branch& branch : {fast, slow}) {
    if (!(branch.fraction >= 0 && fast.fraction + slow.fraction < 1))
      throw in_name("relaxes by " + text(branch.fraction) + "; it must be 0 or more, and less than 1 in all");
    if (!(branch.time_s > 0 && std::isfinite(branch.time_s)))
      throw in_name("relaxes in " + text(branch.time_s) + " s; it must be positive and finite");
  }
}

SectionIntegrals integrate(const std::vector<Section>& sections, double a, double b, std::size_t from) {
  SectionIntegrals sum;
  for (std::size_t k = from; k < sections.size() && (k == from || sections[k].from_tip_m < b); ++k) {
    const Section& s = sections[k];
    // The last section extends to the requested end; the check allowed only for rounding.
    const double end = k + 1 == sections.size() ? std::max(s.to_tip_m, b) : s.to_tip_m;
    const double length = std::min(b, end) - std::max(a, s.from_tip_m);
    if (length <= 0) continue;
    // Second moment of a round section about a diameter, per area: (ro^2 + ri^2) / 4.
    const double gyration2 = (s.radius_m * s.radius_m + s.inner_radius_m * s.inner_radius_m) / 4;
    sum.mass += length * s.kg_per_m;
    sum.transverse_inertia += length * s.kg_per_m * gyration2;
    sum.polar_inertia += length * s.kg_per_m * gyration2 * 2;
    sum.compliance += length * Eigen::Vector3d(1 / s.EI1_N_m2, 1 / s.EI2_N_m2, 1 / s.GJ_N_m2);
    sum.rest_angle += length * s.rest_curvature_per_m;
    for (int j = 0; s.bending.knots > 0 && j <= s.bending.knots; ++j)
      sum.bending.bends_m2[j] += length * slope_change_m(s.bending, j);
    if (s.softening_per_m > 0)
      sum.bending.softening += length * Eigen::Vector2d(1 / s.softening_per_m, 1 - s.softened_ratio);
  }
  return sum;
}

}  // namespace ostium::core
