#pragma once
/// A balloon-expandable stent: rings of struts in zigzag, joined by links; points at the crowns.
///
/// Round about, a ring is an elastic, then plastic hoop: against the radius r it presses
///   p = K (r - R0) / R0,   R0 follows where |r - R0| > y R0
/// so it takes pressure to open, springs back a little when the balloon goes, and then bears the wall: its recoil is
/// where both balance. Struts keep their length l: between crowns half a pitch apart round about, a ring is
///   h = sqrt(l^2 - chord^2)
/// long, and shorter as it opens. Links join crowns that point the same way, so that they keep the rings apart: a stent
/// foreshortens by its ends. Points find their place along the vessel by relaxation of struts and links (springs),
/// links that are pressed together stay so.
#include "vascular/treatment/balloon.h"
#include "vascular/treatment/stent_design.h"

namespace ostium::vascular {

/// A stent of one size. `make_stent` sets the crowns and rings that its design leaves open.
struct StentModel : StentDesign {
  std::string name;
  double nominal_m = 3e-3, length_m = 18e-3;  ///< diameter open; length crimped

  double strut_length_m() const;
  double pitch_m() const { return (length_m - height_m) / (rings - 1); }
  double widest_m() const;  ///< radius at which its struts are straight
  int points() const { return rings * 2 * crowns; }
};
StentModel make_stent(double nominal_m, double length_m, const StentDesign& design = {});
void check(const StentModel& model);  ///< throws std::invalid_argument

/// Where a point of a deployed stent is tied to the wall.
struct StentTie {
  int triangle = -1;    ///< of MovingLumen; -1: none, and
  double u = 0, v = 0;  ///< its barycentric weights of the second and third corner
  double depth_m = 0;   ///< inwards from there
};
constexpr auto fields(const StentTie*) {
  return std::tuple{core::field("triangle", &StentTie::triangle), core::field("u", &StentTie::u),
                    core::field("v", &StentTie::v), core::field("depth_m", &StentTie::depth_m)};
}

struct StentState {
  enum class Where { on_balloon, deployed, lost };
  using enum Where;
  Where where = on_balloon;
  int branch = -1;               ///< along whose path it lies; -1: none. While crimped its balloon's
  double middle_m = 0;           ///< along the path; while crimped its balloon's
  double shift_m = 0;            ///< of the crimped stent on its balloon; negative: proximally
  std::vector<double> radius_m;  ///< (#rings) inner
  std::vector<double> rest_m;    ///< (#rings) R0
  std::vector<double> along_m;   ///< (#points) from its middle, distally; ring by ring, round about
  std::vector<double> link_m;    ///< (#rings - 1) length of the links
  std::vector<StentTie> ties;    ///< (#points)
  std::vector<double> peak_m;    ///< (#rings) when it was widest
};
constexpr auto fields(const StentState*) {
  using S = StentState;
  return std::tuple{core::field("where", &S::where),       core::field("branch", &S::branch),
                    core::field("middle_m", &S::middle_m), core::field("shift_m", &S::shift_m),
                    core::field("radius_m", &S::radius_m), core::field("rest_m", &S::rest_m),
                    core::field("along_m", &S::along_m),   core::field("link_m", &S::link_m),
                    core::field("ties", &S::ties),         core::field("peak_m", &S::peak_m)};
}
StentState make_stent_state(const StentModel& model);

struct StentInputs {
  const VesselPath* path = nullptr;
  const BalloonModel* balloon = nullptr;  ///< in it, or null
  const BalloonState* balloon_state = nullptr;
  double balloon_middle_m = 0;
  double drag_N = 0;  ///< on the crimped stent, along its balloon; negative: proximally. Of an edge that catches it
  double edge_m = -1e9,
         edge_N = 0;  ///< a guide's or balloon's edge that pushes the deployed stent distally, from there
};

struct StentScratch {
  std::vector<double> p_Pa, slope_Pa_m, covers, inner_m;  ///< of the balloon's spheres
};

/// Adds what a stent is to a balloon: call before the balloon's step. `sleeve` points into `scratch`; empty at first.
void add_sleeve(const StentModel& model, const StentState& state, const BalloonModel& balloon,
                const BalloonState& balloon_state, double balloon_middle_m, StentScratch& scratch, Sleeve& sleeve);

/// After the balloon's step: rings follow it or spring back, points settle; holds the wall.
void step(const StentModel& model, const PlaqueModel& plaque, const StentInputs& inputs, double dt_s, StentState& state,
          PlaqueState& wall);

/// Radius inside at a place of the path, or a negative number where it is not.
double inner_radius_at(const StentModel& model, const StentState& state, double s_m);
/// The narrowest that something must pass between two places.
double narrowest_m(const StentModel& model, const StentState& state, double from_m, double to_m);

/// First and last point along the path.
std::pair<double, double> span_of(const StentState& state);

}  // namespace ostium::vascular
