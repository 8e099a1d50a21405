#pragma once
/// What the balloons of one make have in common. A file's `balloon.design` sets these; what it does not say stays as
/// here.

namespace ostium::vascular {

struct BalloonDesign {
  double growth_m_Pa = 0;       ///< of the diameter, with pressure; 0: that of its compliance class, in proportion
  double folded_m = 0.45e-3;    ///< radius before it was ever filled, and
  double refolded_m = 0.55e-3;  ///< emptied again
  double shoulder_m = 2.2e-3;   ///< beyond each marker, over which it falls to the shaft
  double shaft_m = 0.28e-3;     ///< radius of the inner tube, where the shoulders end
  double unfolding_Pa = 0.6 * 101325;
  double filling_Pa_s_m3 = 6e12;  ///< R: 8 s under vacuum for 3.0 x 15 [usual, from memory]
  double viscous_Pa_s_m = 3e8;    ///< c [estimate: a waist gives way in about half a second]
  double friction = 0.12;         ///< against the wall [estimate]
  double grip_N_m = 60;           ///< of the shaft behind it, elastic [estimate]
  double slide_N_s_m = 200;       ///< and viscous [estimate]
};

}  // namespace ostium::vascular
