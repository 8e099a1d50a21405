#pragma once
/// A balloon: a row of spheres along its shaft between two markers, filled through a thin lumen, in contact with the
/// wall.
///
/// At each sphere of radius a, with filling pressure p, per area of its skin:
///   c da/dt = p - p_skin(a) - p_stent(a) - p_wall(a) + N a'',   N = p a / 2 (tension along the skin)
/// The compliance chart is linear above the unfolding pressure: D = nominal + growth (p - nominal pressure); below it
/// the balloon is folded. It fills through the shaft, R dV/dt = p_gauge - p, so that p lags and the balloon empties
/// within seconds under vacuum, and hardly without it, since then only the folds expel the fluid.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "vascular/treatment/balloon_design.h"
#include "vascular/treatment/plaque.h"

namespace ostium::vascular {

enum class Compliance { semi, non };

/// Typical charts of 3.0 mm balloons, in the absence of manufacturers' data (from memory, to be verified):
/// semi-compliant nominal at 8 atm, rated 14, 3.0 -> 3.25; non-compliant nominal 12, rated 20, 3.0 -> 3.1; a growth of
/// 15 % over 8 atm was measured on older ones (AJC 1986;57:26); the classes allow 30 and 10 % at most. Other sizes in
/// proportion.
struct BalloonModel : BalloonDesign {
  std::string name;
  double nominal_m = 3e-3, length_m = 15e-3;  ///< diameter; length between the markers' middles
  double nominal_Pa = 8 * 101325, rated_Pa = 14 * 101325;
  double tip_m = 0;           ///< length of its shaft beyond the distal marker's middle; 0: none
  double tip_radius_m = 0;    ///< largest radius of that shaft and of what lies between the markers
  double iodine_kg_m3 = 175;  ///< half contrast, half saline
  std::uint64_t seed = 0;     ///< determines its burst pressure
};
BalloonModel make_balloon(Compliance compliance, double nominal_m, double length_m, const BalloonDesign& design = {});
/// Throws std::invalid_argument naming the value that is out of range.
void check(const BalloonModel& model);
/// Unconfined diameter, m, for gauge pressures from the unfolding one up.
double chart_diameter_m(const BalloonModel& model, double gauge_Pa);
/// This balloon's burst pressure: 5 to 35 % above the rated one.
double burst_Pa(const BalloonModel& model);

inline constexpr int balloon_spheres = 64;

struct BalloonState {
  std::vector<double> radius_m;  ///< (balloon_spheres) from the proximal to the distal end
  double volume_m3 = 0;          ///< of the filling
  double pressure_Pa = 0;        ///< inside minus outside
  bool was_filled = false;       ///< its factory folds are gone
  bool burst = false;
  double seat_m = 0;                     ///< middle of its markers along the path
  bool held = false;                     ///< pressed by the wall, which keeps it there; else it goes with its shaft
  double holds_N = 0;                    ///< and with how much at most, by friction
  std::vector<Eigen::Vector2d> aside_m;  ///< (balloon_spheres) from the artery's middle line, along side and up
  std::vector<double> flat_rad;          ///< (balloon_spheres) beta, where another lies beside it (side_by_side.h)
  /// To where its proximal and distal bond pull the shaft, in the same way, and how stiffly: as bond and wall are.
  /// Sessions do not use it yet (device_constraints.cpp says why).
  std::array<Eigen::Vector2d, 2> bonds_m = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  std::array<double, 2> bonds_N_m{};
  double largest_m = 0;   ///< largest radius so far
  double inflated_s = 0;  ///< time above 1 atm in this inflation
};
constexpr auto fields(const BalloonState*) {
  using S = BalloonState;
  return std::tuple{core::field("radius_m", &S::radius_m),
                    core::field("volume_m3", &S::volume_m3),
                    core::field("pressure_Pa", &S::pressure_Pa),
                    core::field("was_filled", &S::was_filled),
                    core::field("burst", &S::burst),
                    core::field("seat_m", &S::seat_m),
                    core::field("held", &S::held),
                    core::field("holds_N", &S::holds_N),
                    core::field("aside_m", &S::aside_m),
                    core::field("flat_rad", &S::flat_rad),
                    core::field("bonds_m", &S::bonds_m),
                    core::field("bonds_N_m", &S::bonds_N_m),
                    core::field("largest_m", &S::largest_m),
                    core::field("inflated_s", &S::inflated_s)};
}
BalloonState make_balloon_state(const BalloonModel& model);

/// Where the shaft lies in the artery. `aside_m` and `bend_1_m`: at each sphere, along side and up of the path's frame
/// there (stent_shape.h); empty: both straight, in the middle.
struct ShaftPlace {
  double middle_m = 0;                             ///< midpoint of its markers along the path
  std::span<const Eigen::Vector2d> aside_m = {};   ///< of the shaft
  std::span<const Eigen::Vector2d> bend_1_m = {};  ///< curvature of the artery's middle line, towards the bend's centre
  double holds_N_m = 60;  ///< stiffness behind the bonds, where no rod stands for the shaft [estimate]
};

/// A sleeve around the balloon: the resistance of stents. Empty, or one value per sphere.
struct Sleeve {
  std::span<const double> p_Pa, slope_Pa_m;  ///< pressure at the sphere's radius, and its slope
  double thickness_m = 0;                    ///< between balloon and wall
  std::span<const double> covers;            ///< 1 where the sleeve is
  std::span<const double> inner_m;           ///< its inner radius, below which there is no contact
  std::span<const double> fixed_Pa;          ///< of that pressure, what stents exert that do not go along
  double links_N = 0;                        ///< with which those hold on to each other, ring by ring
};

/// Another balloon in the same lumen. Empty, or one value per sphere.
struct Beside {
  std::span<const double> radius_m;          ///< of the other one at the sphere's place; 0: it is not there
  std::span<const Eigen::Vector2d> aside_m;  ///< and how far it lies aside
  std::span<const double> lumen_m;           ///< of both (SideBySide)
  double to_m = 0;                           ///< along the path: beyond it they lie in vessels of their own
};

struct BalloonInputs {
  const VesselPath* path = nullptr;  ///< null: in free space or in a catheter
  ShaftPlace shaft = {};
  double gauge_Pa = 0;  ///< of the inflation device; -1 atm: vacuum
  Sleeve sleeve = {};
  Beside beside = {};
};

struct BalloonReport {
  double gauge_Pa = 0;
  double axial_N = 0;                   ///< axial force of wall and stents on the shaft; positive distally
  double pressed_N = 0;                 ///< sum of the wall's radial force
  double aside_N = 0;                   ///< what the wall pushes it aside with, in all: its bonds bear that
  double waist = 0;                     ///< narrowest over widest between the markers; below 1: a waist
  double dog_bone = 0;                  ///< radius of the wider end over that of the middle
  double slid_m = 0;                    ///< in this step, along the wall; positive distally
  double spilt_m3 = 0;                  ///< released into the vessel by bursting in this step
  bool touches = false, seals = false;  ///< contact with the wall; contact all round, which blocks flow
};

struct BalloonScratch {
  std::vector<double> below, middle, above, right, unit;
  std::vector<double> back_N_m, back_N_m2;  ///< what the wall pushes each sphere to the middle with, and its slope
  // Of the body (balloon_body.h):
  std::vector<double> diagonal, next, second;
  std::vector<Eigen::Vector2d> load;
};

/// Before a step: what is not held is where its shaft is.
void follow_shaft(double shaft_middle_m, BalloonState& state);

/// Position of a sphere along the path (proximal first); and its share of the full size.
double sphere_position(const BalloonModel& model, const BalloonState& state, int sphere);
double sphere_share(const BalloonModel& model, int sphere);
/// Distance from one sphere to the next.
double spacing_m(const BalloonModel& model);

/// One step of up to 10 ms; updates the wall. Does not allocate after the first call with the same scratch.
BalloonReport step(const BalloonModel& model, const PlaqueModel& plaque, const BalloonInputs& inputs, double dt_s,
                   BalloonState& state, PlaqueState& wall, BalloonScratch& scratch);

/// Radius at a position of the path, 0 beyond the balloon's ends; how flat another one there makes it.
double radius_at(const BalloonModel& model, const BalloonState& state, double s_m);
double flat_at_rad(const BalloonModel& model, const BalloonState& state, double s_m);
/// How far its middle line lies aside at a position of the path; as at its ends beyond them.
Eigen::Vector2d aside_at_m(const BalloonModel& model, const BalloonState& state, double s_m);
/// Stiffness of its skin, E t, which the chart gives: a tube that grows by dr under dp has r^2 dp / dr.
double skin_N_m(const BalloonModel& model);

/// Whether the balloon has refolded.
bool is_empty(const BalloonModel& model, const BalloonState& state);

}  // namespace ostium::vascular
