#pragma once
/// Properties common to all stents of one make. A file's `stent.design` sets these; the defaults are a cobalt-chromium
/// stent with thin struts.

namespace ostium::vascular {

struct StentDesign {
  int crowns = 0;                  ///< distal crowns per ring; 0: 6, or 9 above 3.3 mm
  int rings = 0;                   ///< 0: as many as fit 1.3 mm apart
  int links = 3;                   ///< between two rings; must divide the crowns
  int covered = 0;                 ///< 1: a membrane closes the wall behind it, and the branches that it crosses
  double strut_m = 81e-6;          ///< thickness (XIENCE Sierra)
  double height_m = 1.1e-3;        ///< of a ring, crimped
  double crimped_m = 0.45e-3;      ///< radius
  double hoop_Pa = 30 * 101325;    ///< K
  double yield = 0.036;            ///< y: springs back by about this much (bench: 1.5 to 16 %, CCI 2000;50:112)
  double locks_at = 0.92;          ///< of the radius with straight struts; beyond it they are stretched,
  double lock_stiffening = 30;     ///< this many times stiffer than the hoop
  double link_elastic = 0.04;      ///< strain up to which links are elastic
  double pressed_together = 0.55;  ///< smallest length of a compressed link, relative
  double viscous_Pa_s_m = 3e8;     ///< of the surrounding wall
  double held_N = 1.5;             ///< retention on its balloon when crimped [estimate]
  double crush_N = 0.5;            ///< longitudinal force at which links give way (Prabhu, pressed together: 0.49 N)
};

}  // namespace ostium::vascular
