#pragma once
/// What an instrument is made of, as stated by a catalogue or a measurement.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/material/bending_curve.h"

namespace ostium::core {

/// A stretch of an instrument with uniform properties. SI.
struct Section {
  double from_tip_m = 0;      ///< start, measured from the distal tip along the rod; >= 0
  double to_tip_m = 0;        ///< end; > from_tip_m
  double EI1_N_m2 = 0;        ///< bending stiffness about director d1; > 0
  double EI2_N_m2 = 0;        ///< bending stiffness about director d2; > 0
  double GJ_N_m2 = 0;         ///< torsional stiffness; > 0
  double kg_per_m = 0;        ///< mass per length; > 0
  double radius_m = 0;        ///< outer radius; > 0
  double inner_radius_m = 0;  ///< of the lumen; 0 for a wire
  /// Darboux vector of the unloaded shape in the material frame, 1/m: d_i' = u x d_i towards the tip, so that u1 > 0
  /// turns d3 towards -d2, u2 > 0 turns d3 towards d1, and u3 is a twist. Its norm is below 1 / radius_m.
  Eigen::Vector3d rest_curvature_per_m = Eigen::Vector3d::Zero();
  /// Curvature beyond rest at which bending softens (core/material/superelastic.h), 1/m; 0: never. In superelastic
  /// nitinol this begins at a strain of about 1 %: 0.01 / r for a wire of radius r.
  double softening_per_m = 0;
  double softened_ratio = 1;  ///< ratio of the bending stiffness far beyond softening_per_m to that below it; 0.01 to 1
  /// Bending of another form, by its tangent; not with softening. All sections of a rod have the same knots, or none.
  BendingCurve bending;
};

/// Drag of the surrounding fluid and damping of the material. All zero by default.
struct Damping {
  /// Force per length and velocity across and along the rod, N s/m2. A slender rod in blood (3.5 mPa s) has 4 pi mu /
  /// (ln(2 l / r)) across and half of that along: about 0.007 and 0.0035 (Cox 1970, J Fluid Mech 44:791).
  double drag_across_N_s_m2 = 0;
  double drag_along_N_s_m2 = 0;
  /// Kelvin-Voigt: moment = stiffness (strain + time x strain rate). Polymer shafts: of the order of 1 ms (estimate).
  double material_time_s = 0;
};

/// Stress relaxation of the material (core/material/relaxing.h). None by default.
struct Relaxation {
  struct Branch {
    double fraction = 0;  ///< of the stiffness; >= 0, less than 1 in sum
    double time_s = 1;    ///< > 0
  } branches[2];

  bool any() const { return branches[0].fraction > 0 || branches[1].fraction > 0; }
};

inline constexpr std::size_t least_elements = 16, most_elements = 4096;  ///< of a rod

/// Input for make_rod.
struct RodDescription {
  std::string name;
  std::vector<Section> sections;  ///< from the distal tip backwards, without gaps
  /// From the base to the tip, least_elements to most_elements; their sum is at most the sections' length (the rest
  /// stays behind the base).
  std::vector<double> element_lengths_m;
  Damping damping;
  Relaxation relaxation;
};

/// `count` equal elements over the whole length of the sections.
std::vector<double> equal_elements(const std::vector<Section>& sections, int count);

/// Integrals over a stretch of a rod.
struct SectionIntegrals {
  double mass = 0, transverse_inertia = 0, polar_inertia = 0;
  Eigen::Vector3d compliance = Eigen::Vector3d::Zero();  ///< of (1/EI1, 1/EI2, 1/GJ)
  Eigen::Vector3d rest_angle = Eigen::Vector3d::Zero();  ///< of the rest curvature
  BendingIntegrals bending;
};

/// Integrals over a <= distance from the tip <= b. `from`: first section to consider, one that can reach beyond a.
SectionIntegrals integrate(const std::vector<Section>& sections, double a, double b, std::size_t from = 0);

/// A round section of one material: EI = E pi (ro^4 - ri^4) / 4, GJ = E / (2 (1 + nu)) pi (ro^4 - ri^4) / 2.
Section round_section(double from_tip_m, double to_tip_m, double radius_m, double inner_radius_m, double E_Pa,
                      double nu, double kg_per_m3);

/// Throws std::invalid_argument naming the rod, the section and the wrong value: a gap or overlap, a negative length, a
/// stiffness, weight or radius that is not positive and finite, or relaxation of the whole stiffness.
void check(const RodDescription& description);

}  // namespace ostium::core
