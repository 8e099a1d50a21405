#pragma once
/// Three-point bending of a wire or catheter: force against displacement, there and back.
///
/// Two rollers carry the wire, a third presses it down in the middle. Law: half of it is an elastica from the roller to
/// the middle, where its tangent is level. With psi the angle of the tangent to the perpendicular of the roller's
/// reaction N, from phi at the roller to phi + theta in the middle,
///   EI psi'^2 / 2 = N (sin psi - sin phi),
/// so that the distances along and across that perpendicular are
///   x = sqrt(2 EI / N) sqrt(sin(phi + theta) - sin phi),  y = sqrt(EI / (2 N)) integral of sin psi / sqrt(sin psi -
///   sin phi),
/// and the roller is where the span says: N follows for each theta (Frisch-Fay 1962, Flexible Bars, for phi = 0).
/// Friction holds the wire back as it slides in over the rollers, and as it slides out: phi = -atan(friction) while it
/// is pressed, + on its way back.
///
/// A section law that is not linear, or that remembers, changes this force by the ratio that beams of small slope have
/// with it and without: curvature at 8 stations from the moment's history (`section.h`), deflection by virtual work.
#include "data/identification/curves/set/set_reader.h"
#include "data/identification/curves/three_point_bend/section.h"

namespace ostium::data::three_point_bend {

/// One pass of the machine.
struct Pass {
  double span_m = 0;
  double roller_m = 0;  ///< from a roller's axis to the wire's axis
  double from_tip_m = 0;
  std::vector<std::pair<std::size_t, double>> share;  ///< of the compliance, by section
  Eigen::VectorXd time_s, displacement_m;             ///< time since the first pass began
};

/// Everything that an effect may change.
struct Setup {
  std::vector<Pass> passes;
  std::vector<double> EI_N_m2;  ///< of each section
  double radius_m = 0;          ///< of the instrument
  double span_more_m = 0;       ///< the span against what is declared
  double machine_m_per_N = 0;   ///< how far the machine gives way
  double friction = 0;          ///< at the rollers
  double zero_N = 0, drift_N_per_s = 0;
  double relaxing = 0, relaxation_s = 1;  ///< share of the force that relaxes, with which time
  SectionLaw section;
};

curves::Kind kind();

/// Forces of each pass, N.
std::vector<curves::Curves> forces(const Setup& setup);

/// The largest curvature of a linear beam of small slope in any pass, 12 deflection / span^2.
double largest_curvature_per_m(const Setup& setup);

/// Each states its law in its source file.
using Effect = curves::EffectOn<Setup>;
Effect support_friction();
Effect coil_core_slip();
Effect plastic_set();
Effect superelastic_flag();
Effect relaxation();
Effect machine_compliance();
Effect span_error();
Effect zero_offset();
Effect force_drift();
Effect law_bending();
Effect law_bending_hysteresis();

}  // namespace ostium::data::three_point_bend
