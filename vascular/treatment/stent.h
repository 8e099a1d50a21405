#pragma once
/// A balloon-expandable stent: rings of zigzag struts, joined by links; points at the crowns.
///
/// Circumferentially, a ring is an elastic-plastic hoop: at radius r it resists with
///   p = K (r - R0) / R0,   R0 follows where |r - R0| > y R0
/// so it needs pressure to open, springs back slightly when the balloon is removed, and then supports the wall: recoil
/// ends where both balance. Struts keep their length l: with crowns half a pitch apart along the circumference, a
/// ring's length is
///   h = sqrt(l^2 - chord^2)
/// and shrinks as it opens. Two balloons side by side leave a ring that is not round; its radius is that of a circle of
/// its length, and one balloon that fills it makes it round again (side_by_side.h). A balloon through one of its cells
/// pushes the points that are in its way aside, for good. Links join crowns that point the same way and so keep the
/// rings apart: a stent foreshortens at its ends. Points are positioned along the vessel by relaxing struts and links
/// as springs; compressed links stay compressed.
#include "vascular/treatment/balloon.h"
#include "vascular/treatment/stent_design.h"

namespace ostium::vascular {

inline constexpr int most_crowns = 24;  ///< per ring

/// A stent of one size. `make_stent` sets the crowns and rings left open by its design.
struct StentModel : StentDesign {
  std::string name;
  double nominal_m = 3e-3, length_m = 18e-3;  ///< diameter when open; length when crimped

  double strut_length_m() const;
  double pitch_m() const { return (length_m - height_m) / (rings - 1); }
  double widest_m() const;  ///< radius at which its struts are straight
  int points() const { return rings * 2 * crowns; }
};
StentModel make_stent(double nominal_m, double length_m, const StentDesign& design = {});
void check(const StentModel& model);  ///< throws std::invalid_argument

/// Where a point of a deployed stent is attached to the wall.
struct StentTie {
  static constexpr int untied = -1, out_of_reach = -2;
  int triangle = untied;               ///< of MovingLumen
  double u = 0, v = 0;                 ///< barycentric weights of the second and third corner
  double depth_m = 0;                  ///< inwards from that point
  double along_m = 0, turned_rad = 0;  ///< of StentState, when it was attached
};
constexpr auto fields(const StentTie*) {
  return std::tuple{core::field("triangle", &StentTie::triangle),
                    core::field("u", &StentTie::u),
                    core::field("v", &StentTie::v),
                    core::field("depth_m", &StentTie::depth_m),
                    core::field("along_m", &StentTie::along_m),
                    core::field("turned_rad", &StentTie::turned_rad)};
}

struct StentState {
  enum class Where { on_balloon, deployed, lost };
  using enum Where;
  Where where = on_balloon;
  int branch = -1;               ///< branch whose path contains it; -1: none. While crimped, that of its balloon
  double middle_m = 0;           ///< along the path; while crimped, that of its balloon
  double shift_m = 0;            ///< of the crimped stent relative to its balloon; negative: proximally
  std::vector<double> radius_m;  ///< (#rings) inner
  std::vector<double> rest_m;    ///< (#rings) R0
  std::vector<double> along_m;   ///< (#points) from its middle, distally; by ring, then around it
  /// (#points) How far a balloon through a cell has pushed it, distally and about the path, for good.
  std::vector<double> pushed_m, turned_rad;
  std::vector<double> link_m;  ///< (#rings - 1) length of the links
  std::vector<StentTie> ties;  ///< (#points)
  std::vector<double> peak_m;  ///< (#rings) largest radius so far
  std::vector<double> narrow;  ///< (#rings) narrow over wide diameter; 1: round
};
constexpr auto fields(const StentState*) {
  using S = StentState;
  return std::tuple{core::field("where", &S::where),
                    core::field("branch", &S::branch),
                    core::field("middle_m", &S::middle_m),
                    core::field("shift_m", &S::shift_m),
                    core::field("radius_m", &S::radius_m),
                    core::field("rest_m", &S::rest_m),
                    core::field("along_m", &S::along_m),
                    core::field("pushed_m", &S::pushed_m),
                    core::field("turned_rad", &S::turned_rad),
                    core::field("link_m", &S::link_m),
                    core::field("ties", &S::ties),
                    core::field("peak_m", &S::peak_m),
                    core::field("narrow", &S::narrow)};
}
StentState make_stent_state(const StentModel& model);

/// A balloon in the lumen of a stent, and how far along their common path.
struct BalloonInside {
  const BalloonModel* model = nullptr;
  const BalloonState* state = nullptr;
  double to_m = 1;
  double slid_m = 0;  ///< in this step, along the wall; positive distally
};
/// What balloons open a lumen to at a place: the radius of its perimeter, and narrow over wide; 0: none is there.
struct OpenedTo {
  double radius_m = 0, narrow = 1;
};
OpenedTo opened_to(std::span<const BalloonInside> inside, double s_m);

/// A balloon that leaves through a cell of the stent into a side branch: a circle of its radius across the vessel, an
/// ellipse along it.
struct ThroughCell {
  double radius_m = 0;   ///< 0: none does
  double at_m = 0;       ///< its middle along the stent's path
  double angle_rad = 0;  ///< and about it, from side to up
  double longer = 1;     ///< how much longer than wide its hole is
};

struct StentInputs {
  const VesselPath* path = nullptr;
  std::span<const BalloonInside> inside = {};  ///< at most two
  const BalloonState* carried_by = nullptr;    ///< the balloon that it is crimped on
  ThroughCell through = {};
  double drag_N = 0;  ///< Force of an edge that catches the crimped stent, along its balloon; negative: proximally.
  double edge_m = -1e9,
         edge_N = 0;  ///< Force of a guide's or balloon's edge that pushes the deployed stent distally, from edge_m.
};

struct StentScratch {
  std::vector<double> ring_m;                                       ///< where the middles of its rings lie
  std::vector<double> p_Pa, slope_Pa_m, covers, inner_m, fixed_Pa;  ///< per sphere of the balloon
};

/// Adds a stent's resistance to the sleeve of a balloon in it; call before the balloon's step. `lumen_m`: to which each
/// sphere opens it. `sleeve` points into `scratch`; empty at first.
void add_sleeve(const StentModel& model, const StentState& state, const BalloonInside& balloon,
                std::span<const double> lumen_m, StentScratch& scratch, Sleeve& sleeve);

/// After the balloon's step: rings follow the balloon or spring back, points are relaxed, the wall is held open.
void step(const StentModel& model, const PlaqueModel& plaque, const StentInputs& inputs, double dt_s, StentState& state,
          PlaqueState& wall);

/// Inner radius at a position of the path; negative where there is no stent.
double inner_radius_at(const StentModel& model, const StentState& state, double s_m);
/// Area of a ring's lumen, m2: two half circles and what lies straight between them.
double area_of_ring_m2(const StentState& state, int ring);
/// Smallest radius between two positions.
double narrowest_m(const StentModel& model, const StentState& state, double from_m, double to_m);

/// Position of a ring's middle and of a point along the path.
double ring_middle_m(const StentModel& model, const StentState& state, int ring);
double place_of_m(const StentState& state, int point);
/// Angle of a point about the path, from side to up; the first crown is at the side direction.
double angle_of(const StentModel& model, const StentState& state, int point);
/// First and last point along the path.
std::pair<double, double> span_of(const StentState& state);

}  // namespace ostium::vascular
