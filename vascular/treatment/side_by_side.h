#pragma once
/// Two balloons side by side in one lumen, as in a kissing inflation: the wall is drawn round both, and they flatten
/// each other.
///
/// Free, they are two circles of radii a and b that touch. The wall round them is two arcs and two straight lines:
///   H = pi (a + b) + 2 t (a - b) + 4 sqrt(a b),   sin t = (a - b) / (a + b)
/// Squeezed, two equal ones are arcs of radius rho that meet on a flat chord, which each sees under the angle 2 beta.
/// Their skins do not stretch:
///   rho = pi a / q,   q = pi - beta + sin beta,   L = 2 pi rho + 4 rho cos beta
/// They are at rest where the wall's tension T does the work of their pressure p, T dL = p dA:
///   T / p = A' / L',   A = 2 rho^2 (pi - beta + sin beta cos beta)
/// from 0, two circles, to T = p rho, one round lumen of two halves, whose radius is
///   (a^k + b^k)^(1 / k),   k = 3.46
/// for equal ones by the above, and the larger's where the other vanishes. In between, unequal ones go the same share
/// of the way as equal ones do. [closed forms of our own; two of 3.0 mm in a vessel of 4.0 mm are 0.75 as wide one way
/// as the other; bench 0.72, Foin et al., EuroIntervention 2011;7:597]

namespace ostium::vascular {

/// The section of a lumen with two balloons in it, of radii a and b.
struct SideBySide {
  double lumen_m = 0;  ///< radius of a circle of its perimeter
  double by_a = 1;     ///< its derivative by a
  double narrow = 1;   ///< its narrow diameter over its wide one
  double apart_m = 0;  ///< between the middles of the two
};
/// `flat_rad`: beta, [0, pi / 2]. Where b is 0 there is one round balloon.
SideBySide side_by_side(double a_m, double b_m, double flat_rad);
/// What draws them together: the wall's pressure at a lumen's radius, and its slope, from which it is not far.
struct DrawnBy {
  double p_Pa = 0, slope_Pa_m = 0, lumen_m = 0;
};
/// The angle beta at which two, filled to a pressure above 0, are at rest in that wall: the root of
///   (a + b) / 2 p A' / L' = T(R(beta)),   T(R) = R (p_Pa + slope (R - lumen))
double flattened_rad(double a_m, double b_m, double filled_Pa, const DrawnBy& wall);

/// The narrow diameter over the wide one, at least, of a ring of which one round balloon fills a part: its perimeter is
/// drawn round the balloon and straight beyond. `lumen_m`: as above.
double drawn_round(double balloon_m, double lumen_m);

}  // namespace ostium::vascular
