#pragma once
/// Bending of a thin tube under pressure, as an inflated balloon is: elastic until its skin wrinkles on the inner side
/// of the bend, then softer, up to a largest moment (Stein and Hedgepeth, NASA TN D-813, 1961).
///
/// With EI = pi r^3 E t and the largest moment M = pi r^3 p; wrinkles reach from the inner side round to the angle f:
///   EI u / M = pi / (2 (sin f + (pi - f) cos f)),   m / M = (2 pi - 2 f + sin 2f) / (4 (sin f + (pi - f) cos f))
/// from f = 0, where m = EI u = M / 2.
namespace ostium::vascular {

struct PressurisedTube {
  double EI_N_m2 = 0;  ///< without wrinkles; 0: no tube
  double most_Nm = 0;  ///< the moment that it cannot exceed
};

/// `stretch_N_m`: E t of the skin, which its compliance chart gives: a tube that grows by dr under dp has r^2 dp / dr.
PressurisedTube pressurised_tube(double radius_m, double pressure_Pa, double stretch_N_m);

/// The moment at a curvature >= 0, Nm.
double moment_Nm(const PressurisedTube& tube, double curvature_1_m);

}  // namespace ostium::vascular
