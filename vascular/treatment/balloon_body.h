#pragma once
/// Where a balloon's body lies in its artery: its middle line may lie aside of the artery's, and it slides along.
///
/// Aside: the body is a tube under pressure with an axis of its own. Both ends are bonded to the shaft, which lies
/// loose inside in between. For the distance y of its middle line from the artery's, per length,
///   c dy/dt + m'' + W(y) + S(y) = 0,   m = EI (u + y'')
/// where u is the artery's curvature, EI that of the tube with its wrinkles (pressurised_tube.h), S the springs of the
/// bonds, and of the shaft where it presses on the skin from inside; W the wall's law round the circle that lies aside:
///   W = integral of p(a + y cos f) cos f a df
/// Its radius answers as if it lay in the middle: a side that alone touches is borne by the shaft's own contact.
/// Along: friction by Coulomb holds it against the cone of wall and stents and the pull of its shaft. In a stent it
/// takes the rings that it presses along, so that their links hold it, too.
#include "vascular/treatment/balloon.h"

namespace ostium::vascular {

/// A wall's answer to a circle of radius a whose middle lies aside of its own by y.
struct CircleAside {
  double back_N_m = 0;   ///< W, towards the wall's middle
  double back_N_m2 = 0;  ///< its slope by y
};
/// `from_m`: radius from which on the circle touches; what the wall presses with there bears on something else.
CircleAside press_circle(const WallLaw& wall, double from_m, double a_m, double aside_m);

/// One step of any length; uses `back_N_m` and `back_N_m2` of the balloon's step. `shaft.aside_m` is not empty.
void lie_aside(const BalloonModel& model, const ShaftPlace& shaft, const Beside& beside, double dt_s,
               BalloonScratch& scratch, BalloonState& state);

/// What moves and holds it along the wall: as in BalloonReport and Sleeve, and what presses it and another beside it
/// together, which is on a shaft of its own and taken as resting.
struct Along {
  double axial_N = 0, pressed_N = 0, links_N = 0, beside_N = 0;
};
void slide(const BalloonModel& model, const ShaftPlace& shaft, const Along& along, double dt_s, BalloonState& state);

}  // namespace ostium::vascular
