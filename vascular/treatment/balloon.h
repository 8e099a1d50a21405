#pragma once
/// A balloon: spheres in a row along its shaft between two markers, filled through a thin tube, pressed against the
/// wall.
///
/// At each sphere, radius a, with the pressure p of what fills it, per area of its skin:
///   c da/dt = p - p_skin(a) - p_stent(a) - p_wall(a) + N a'',   N = p a / 2 (tension along the skin)
/// The skin's chart is linear above the unfolding pressure: D = nominal + growth (p - nominal pressure); below it the
/// balloon is folded. The filling comes through the shaft, R dV/dt = p_gauge - p, so that p follows with a delay and
/// the balloon empties in seconds under vacuum and hardly without: nothing but the folds drives it out then.
#include <cstdint>
#include <span>
#include <string>

#include "vascular/treatment/balloon_design.h"
#include "vascular/treatment/plaque.h"

namespace ostium::vascular {

enum class Compliance { semi, non };

/// Typical charts of 3.0 mm balloons, for want of makers' (from memory, to be verified): semi-compliant nominal at 8
/// atm, rated 14, 3.0 -> 3.25; non-compliant nominal 12, rated 20, 3.0 -> 3.1; growth of 15 % over 8 atm was measured
/// on older ones (AJC 1986;57:26), at most 30 and 10 % are what the classes mean. Other sizes in proportion.
struct BalloonModel : BalloonDesign {
  std::string name;
  double nominal_m = 3e-3, length_m = 15e-3;  ///< diameter; between the markers' middles
  double nominal_Pa = 8 * 101325, rated_Pa = 14 * 101325;
  double iodine_kg_m3 = 175;  ///< half contrast, half saline
  std::uint64_t seed = 0;     ///< of the pressure at which it bursts
};
BalloonModel make_balloon(Compliance compliance, double nominal_m, double length_m, const BalloonDesign& design = {});
/// Throws std::invalid_argument naming what is out of range.
void check(const BalloonModel& model);
/// Unconfined, m; for gauge pressures from the unfolding one up.
double chart_diameter_m(const BalloonModel& model, double gauge_Pa);
/// The pressure at which this one bursts: 5 to 35 % above the rated one.
double burst_Pa(const BalloonModel& model);

inline constexpr int balloon_spheres = 64;

struct BalloonState {
  std::vector<double> radius_m;  ///< (balloon_spheres) from the proximal end to the distal one
  double volume_m3 = 0;          ///< of what fills it
  double pressure_Pa = 0;        ///< inside, over that outside
  bool was_filled = false;       ///< its folds are no longer the maker's
  bool burst = false;
  double slip_m = 0;      ///< how far it slid along the vessel, from where its shaft is
  double largest_m = 0;   ///< radius ever
  double inflated_s = 0;  ///< time above 1 atm in this inflation
};
constexpr auto fields(const BalloonState*) {
  using S = BalloonState;
  return std::tuple{core::field("radius_m", &S::radius_m),
                    core::field("volume_m3", &S::volume_m3),
                    core::field("pressure_Pa", &S::pressure_Pa),
                    core::field("was_filled", &S::was_filled),
                    core::field("burst", &S::burst),
                    core::field("slip_m", &S::slip_m),
                    core::field("largest_m", &S::largest_m),
                    core::field("inflated_s", &S::inflated_s)};
}
BalloonState make_balloon_state(const BalloonModel& model);

/// A sleeve about the balloon: what stents answer to it. Empty, or one value per sphere.
struct Sleeve {
  std::span<const double> p_Pa, slope_Pa_m;  ///< pressure at the sphere's radius, and its growth
  double thickness_m = 0;                    ///< it keeps the balloon from the wall
  std::span<const double> covers;            ///< 1 where it is
  std::span<const double> inner_m;           ///< its radius: within that the balloon meets nothing
};

struct BalloonInputs {
  const VesselPath* path = nullptr;  ///< null: in free space, or in a catheter
  double middle_m = 0;               ///< between its markers, along the path
  double gauge_Pa = 0;               ///< of the inflation device; -1 atm: vacuum
  Sleeve sleeve = {};
};

struct BalloonReport {
  double gauge_Pa = 0;
  double axial_N = 0;                   ///< on the shaft, distally; what the wall presses it along with
  double pressed_N = 0;                 ///< sum of what the wall presses it with, all round
  double waist = 0;                     ///< narrowest over widest of the part between the markers, less than 1: a waist
  double dog_bone = 0;                  ///< wider end over the middle
  double spilt_m3 = 0;                  ///< into the vessel, by bursting, in this step
  bool touches = false, seals = false;  ///< the wall; all round it, so that no blood passes
};

struct BalloonScratch {
  std::vector<double> below, middle, above, right, unit;
};

/// Where its spheres lie along the path (proximal first), with what it has slid; and their share of the full size.
double sphere_position(const BalloonModel& model, const BalloonState& state, double middle_m, int sphere);
double sphere_share(const BalloonModel& model, int sphere);

/// One step of up to 10 ms; the wall gives way under it. Does not allocate after the first call with the same scratch.
BalloonReport step(const BalloonModel& model, const PlaqueModel& plaque, const BalloonInputs& inputs, double dt_s,
                   BalloonState& state, PlaqueState& wall, BalloonScratch& scratch);

/// Radius at a place of the path, 0 beyond its ends.
double radius_at(const BalloonModel& model, const BalloonState& state, double middle_m, double s_m);

}  // namespace ostium::vascular
