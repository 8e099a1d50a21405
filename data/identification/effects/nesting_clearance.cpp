/// Clearance between nested instruments: near the end of an outer one, the inner one crosses from one side of the bore
/// to the other and leaves it at an angle. Offset and angle are computed for two beams in contact at small deflection
/// (beams_with_play.h) and applied to the shared centreline as a kink. Includes loads at the innermost tip; twist and
/// weight are neglected.
#include <Eigen/Geometry>
#include <cmath>

#include "core/base/units.h"
#include "data/identification/effects/beams_with_play.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace nesting_clearance_parts {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

using units::mm;
constexpr int cells = 100;         // along the overlap of two instruments
constexpr double step_m = 1.5e-3;  // length of the transition from the outer to the inner centreline

std::string why_not(const MeasurementSet& set, std::optional<int>) {
  if (set.vessel) return "in a vessel instruments have their clearance";
  return set.instruments.size() > 1 ? "" : "nothing is nested";
}

const core::Section& section_at(const core::ConcentricPart& part, double from_base) {
  const double from_tip = part.inserted_m - from_base;
  for (const core::Section& s : part.sections)
    if (from_tip < s.to_tip_m) return s;
  return part.sections.back();
}

double stiffness(const core::Section& s) { return std::sqrt(s.EI1_N_m2 * s.EI2_N_m2); }

/// Free curvature of a part towards d1 and d2 of the unrolled base, 1/m. Twist of the shafts is neglected.
Vector2d bend_of(const core::ConcentricPart& part, const core::Section& s) {
  return Eigen::Rotation2Dd(part.roll_rad) * Vector2d(s.rest_curvature_per_m.y(), -s.rest_curvature_per_m.x());
}

/// Advances frame and position along a piece of constant curvature.
void go_on(double length, const Vector2d& bend_per_m, Matrix3d& R, Vector3d& p) {
  const Vector3d turn(-bend_per_m.y() * length, bend_per_m.x() * length, 0);
  const Matrix3d half = (turn.norm() > 0 ? Eigen::AngleAxisd(turn.norm() / 2, turn.normalized())
                                         : Eigen::AngleAxisd(0, Vector3d::UnitX()))
                            .toRotationMatrix();
  R = R * half;
  p += length * R.col(2);
  R = R * half;
}

/// Two instruments as beams.
BeamsWithPlay beams_of(const core::ConcentricPart& outer, const core::ConcentricPart& inner, double play_m,
                       const ExperimentSetup& setup) {
  BeamsWithPlay beams;
  beams.play_m = play_m;
  double share = 0;  // outer beam's share of the total stiffness
  beams.cell_m = outer.inserted_m / cells;
  Matrix3d R = Matrix3d::Identity();
  Vector3d p = Vector3d::Zero();
  for (int k = 0; k < cells; ++k) {
    const double at = (k + 0.25) * beams.cell_m;
    const core::Section &a = section_at(outer, at), &b = section_at(inner, at);
    const double A = stiffness(a), B = stiffness(b);
    share = A / (A + B);
    beams.EI_r_N_m2.push_back(A * B / (A + B));
    beams.differ_per_m.push_back(bend_of(inner, b) - bend_of(outer, a));
    go_on(beams.cell_m, share * bend_of(outer, a) + (1 - share) * bend_of(inner, b), R, p);
  }
  if (setup.tip_force_N.isZero()) return beams;
  // Load on the inner tip. d moves that tip by its offset, and by its slope times the lever arm.
  const Matrix3d tip = R;
  Vector3d lever = Vector3d::Zero();
  const double piece = (inner.inserted_m - outer.inserted_m) / cells;
  for (int k = 0; k < cells; ++k)
    go_on(piece, bend_of(inner, section_at(inner, outer.inserted_m + (k + 0.5) * piece)), R, lever);
  const Eigen::Vector4d& q = setup.base.q_W;
  const Vector3d F = tip.transpose() * (Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate() * setup.tip_force_N);
  lever = tip.transpose() * lever;
  beams.tip_force_N = share * F.head<2>();
  beams.tip_couple_Nm = share * (lever.z() * F.head<2>() - F.z() * lever.head<2>());
  return beams;
}

/// Adds rest curvature to a part between two distances from the base.
void bend(core::ConcentricPart& part, double from_base, double to_base, const Vector2d& more_per_m) {
  const Vector2d own = Eigen::Rotation2Dd(-part.roll_rad) * more_per_m;
  change_stretch(part.sections, part.inserted_m - to_base, part.inserted_m - from_base,
                 [&](core::Section& s) { s.rest_curvature_per_m.head<2>() += Vector2d(-own.y(), own.x()); });
}

/// Makes the shared line, which bends as if there were no play, follow the outer centreline and, past its tip, the
/// inner one. The outer centreline is offset from that line by -d EI_inner / (EI_inner + EI_outer); since the inner
/// part has the same weight in the line's bending, it gets the extra curvature -d''.
void lead(const BeamsWithPlay& beams, const core::ConcentricPart& outer, core::ConcentricPart& inner) {
  const Offsets d = offsets_of(beams);
  const double h = beams.cell_m, tip = outer.inserted_m;
  for (int k = 0; k <= cells; ++k)
    bend(inner, std::max(k - 0.5, 0.0) * h, std::min((k + 0.5) * h, tip), -d.bend_per_m[k]);
  const double step = std::min(step_m, (inner.inserted_m - tip) / 3);
  const Vector2d aside = d.tip_m / (step * step) + d.tip_slope / (2 * step);
  bend(inner, tip, tip + step, aside + d.tip_slope / step);
  bend(inner, tip + step, tip + 2 * step, -aside);
}

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, ExperimentSetup& setup) {
  auto& parts = setup.nest.parts;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    if (effect.values[0] <= 0 || parts[i + 1].inserted_m <= parts[i].inserted_m) continue;
    lead(beams_of(parts[i], parts[i + 1], effect.values[0] * mm, setup), parts[i], parts[i + 1]);
  }
}

/// Sets spread and limit from the declared bores and radii.
void adapt(const MeasurementSet& set, std::optional<int>, std::vector<EffectParameter>& p) {
  double most = 0;
  for (std::size_t i = 0; i + 1 < set.instruments.size(); ++i)
    most = std::max(most, set.instruments[i].inner_radius_m - set.instruments[i + 1].radius_m);
  p[0].spread = std::clamp(most / mm, 0.02, 0.3), p[0].most = std::max(4 * p[0].spread, 0.2);
}

}  // namespace nesting_clearance_parts

Effect nesting_clearance() {
  using namespace nesting_clearance_parts;
  Effect effect;
  effect.id = "nesting_clearance";
  effect.what = "play between nested instruments";
  effect.parameters = {{"clearance_mm", "mm", "play on each side of the inner instrument", 0, 0.1, 0, 2, false}};
  effect.why_not = why_not, effect.apply = apply, effect.adapt = adapt;
  return effect;
}

}  // namespace ostium::data
