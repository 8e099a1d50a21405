#pragma once
/// Properties common to all balloons of one make. A file's `balloon.design` sets these; the defaults are below.

namespace ostium::vascular {

struct BalloonDesign {
  double growth_m_Pa = 0;       ///< of the diameter per pressure; 0: that of the compliance class, scaled to size
  double folded_m = 0.45e-3;    ///< radius before it was ever filled
  double refolded_m = 0.55e-3;  ///< radius when emptied again
  double shoulder_m = 2.2e-3;   ///< length beyond each marker over which it tapers to the shaft
  double shaft_m = 0.28e-3;     ///< radius of the inner tube at the ends of the shoulders
  double unfolding_Pa = 0.6 * 101325;
  double filling_Pa_s_m3 = 6e12;  ///< R: 8 s under vacuum for 3.0 x 15 [typical, from memory]
  double viscous_Pa_s_m = 3e8;    ///< c [estimate: a waist gives way in about half a second]
  double friction = 0.12;         ///< against the wall [estimate]
  double bond_N_m = 1000;         ///< stiffness with which its bonds hold the body on the shaft [estimate]
  double slide_N_s_m = 200;       ///< damping of what its wall pushes along [estimate]
};

}  // namespace ostium::vascular
