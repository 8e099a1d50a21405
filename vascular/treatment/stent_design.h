#pragma once
/// What the stents of one make have in common. A file's `stent.design` sets these; what it does not say stays as here:
/// a cobalt-chromium stent of thin struts.

namespace ostium::vascular {

struct StentDesign {
  int crowns = 0;                  ///< that point distally, per ring; 0: 6, and 9 above 3.3 mm
  int rings = 0;                   ///< 0: as many as fit, 1.3 mm apart
  int links = 3;                   ///< between two rings; they divide the crowns
  double strut_m = 81e-6;          ///< thickness (XIENCE Sierra)
  double height_m = 1.1e-3;        ///< of a ring, crimped
  double crimped_m = 0.45e-3;      ///< radius
  double hoop_Pa = 30 * 101325;    ///< K
  double yield = 0.036;            ///< y: springs back by about as much (bench: 1.5 to 16 %, CCI 2000;50:112)
  double locks_at = 0.92;          ///< of the radius at which struts are straight: from there on they are drawn out,
  double lock_stiffening = 30;     ///< so many times as stiff as the hoop
  double link_elastic = 0.04;      ///< strain up to which links spring back
  double pressed_together = 0.55;  ///< links give way to this share of their length
  double viscous_Pa_s_m = 3e8;     ///< of the wall about it
  double held_N = 1.5;             ///< crimped on its balloon [estimate]
  double crush_N = 0.5;            ///< longitudinal load that presses rings together (Prabhu: 0.49 N)
};

}  // namespace ostium::vascular
