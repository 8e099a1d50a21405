#pragma once
/// The numbers of a balloon's or stent's `design` block, one row each: key, member and limits. The reader loops over
/// these rows and the keys are generated from them, so a new number is one new row.
#include "data/formats/json/json_object.h"
#include "vascular/treatment/balloon_design.h"
#include "vascular/treatment/stent_design.h"

namespace ostium::data {

template <class Design>
struct DesignNumber {
  std::string key;
  double Design::*member;
  double unit;         ///< multiplies the file's number to give the member
  double least, most;  ///< of the file's number
  std::string text;    ///< how messages describe it, before its limits
};

struct StentCount {
  std::string key;
  int vascular::StentDesign::*member;
  int least, most;
  std::string text;
};

inline const std::vector<StentCount> stent_design_counts = {
    {"crowns", &vascular::StentDesign::crowns, 3, 24, "crowns of a ring that point distally"},
    {"rings", &vascular::StentDesign::rings, 2, 100, "rings of struts"},
    {"links", &vascular::StentDesign::links, 1, 24, "links between two rings, which divide its crowns"},
    {"covered", &vascular::StentDesign::covered, 0, 1, "1: a membrane covers it"}};

inline const std::vector<DesignNumber<vascular::StentDesign>> stent_design_numbers = {
    {"strut_mm", &vascular::StentDesign::strut_m, 1e-3, 0.03, 0.3, "a strut's thickness in mm"},
    {"ring_length_mm", &vascular::StentDesign::height_m, 1e-3, 0.3, 4,
     "a ring's length along the stent, crimped, in mm"},
    {"crimped_radius_mm", &vascular::StentDesign::crimped_m, 1e-3, 0.3, 1, "the inner radius on its balloon in mm"},
    {"hoop_atm", &vascular::StentDesign::hoop_Pa, 101325, 1, 300,
     "the pressure of a ring per relative change of radius in atm"},
    {"yield_strain", &vascular::StentDesign::yield, 1, 0.001, 0.3,
     "the relative change of radius from which a ring yields"},
    {"locks_at", &vascular::StentDesign::locks_at, 1, 0.5, 1,
     "the share of its widest radius from which struts are drawn out"},
    {"lock_stiffening", &vascular::StentDesign::lock_stiffening, 1, 1, 1000,
     "how many times stiffer a ring is beyond that"},
    {"link_elastic_strain", &vascular::StentDesign::link_elastic, 1, 0.001, 0.3,
     "the strain up to which links spring back"},
    {"link_crush_share", &vascular::StentDesign::pressed_together, 1, 0.1, 1,
     "the least that links are pressed to, of their length"},
    {"viscous_Pa_s_m", &vascular::StentDesign::viscous_Pa_s_m, 1, 1e6, 1e11, "the damping of a ring in Pa s/m"},
    {"held_N", &vascular::StentDesign::held_N, 1, 0.01, 20, "the force in N that pulls it off its balloon"},
    {"crush_N", &vascular::StentDesign::crush_N, 1, 0.01, 20, "the load along it in N at which its links give way"}};

inline const std::vector<DesignNumber<vascular::BalloonDesign>> balloon_design_numbers = {
    {"growth_mm_per_atm", &vascular::BalloonDesign::growth_m_Pa, 1e-3 / 101325, 1e-4, 0.5,
     "growth of its diameter in mm/atm"},
    {"folded_radius_mm", &vascular::BalloonDesign::folded_m, 1e-3, 0.3, 2, "its radius before it was filled in mm"},
    {"refolded_radius_mm", &vascular::BalloonDesign::refolded_m, 1e-3, 0.3, 2, "its radius when emptied again in mm"},
    {"shoulder_mm", &vascular::BalloonDesign::shoulder_m, 1e-3, 0.3, 10, "the shoulder's length beyond a marker in mm"},
    {"inner_tube_radius_mm", &vascular::BalloonDesign::shaft_m, 1e-3, 0.1, 1, "the inner tube's radius in mm"},
    {"unfolding_atm", &vascular::BalloonDesign::unfolding_Pa, 101325, 0.05, 5, "the pressure that unfolds it in atm"},
    {"filling_Pa_s_m3", &vascular::BalloonDesign::filling_Pa_s_m3, 1, 1e10, 1e15,
     "the shaft's resistance to its filling in Pa s/m3"},
    {"viscous_Pa_s_m", &vascular::BalloonDesign::viscous_Pa_s_m, 1, 1e6, 1e11, "the damping of its radius in Pa s/m"},
    {"friction", &vascular::BalloonDesign::friction, 1, 0, 2, "friction against the wall"},
    {"bond_N_m", &vascular::BalloonDesign::bond_N_m, 1, 1, 1e5,
     "the stiffness in N/m with which its bonds hold it on its shaft"},
    {"slide_N_s_m", &vascular::BalloonDesign::slide_N_s_m, 1, 1, 1e6,
     "the damping in N s/m of what its wall pushes along"}};

}  // namespace ostium::data
