#pragma once
/// The closed circulation: both ventricles, the pericardium round them, systemic and pulmonary vessels, all the blood,
/// and the baroreflex. Its volumes change only by what flows between them; what leaves or enters the body is counted.
///
///   ventricle    P = a E (V - V0) + (1 - a) P1 (e^(l V) - 1) + P_peri     (Smith et al. 2004, Med Eng Phys 26:131)
///   pericardium  P_peri = P0 (e^(lambda (V_lv + V_rv + fluid - V0)) - 1) + P_chest             (the same)
///   vessels      P = (V - V_unstressed) / C;   flows: pressure differences over resistances, valves open one way
///   aortic root  L dQ/dt = P_lv - P_arteries - (R_valve + Z) Q;  the valve shuts after a little has flowed back
///   baroreflex   x = s atan((P_set - P_mean) / s) acts, each by a delay and a time constant, on heart period,
///                resistance, contractility and unstressed venous volume      (form and gains: Heldt 2004, delays:
///                Ursino 1998, Am J Physiol 275:H1733)
///
/// The atria have no volume of their own: their contraction adds to the pressure of the veins before the R wave.
///
/// Constants are Smith's and Heldt's, in mmHg and mL, but those that were moved, so that a person at rest has 120/78
/// mmHg and 5.2 L/min at 70 beats a minute, and tamponade comes out as in tests/vascular/flow/circulation_test.cpp:
///   pericardium  lambda 0.030 -> 0.034 per mL, V0 200 -> 180 mL: an acute 150 to 250 mL, not 300, is the end
///   chest        -4 -> -2 mmHg, and -8 more in a full breath: supine; pulsus of 4 mmHg at rest, above 10 in tamponade
///   right side   P1 0.216 -> 0.30 mmHg; venous compliance (Heldt's 112, 64 in postoperative patients) -> 30 mL/mmHg,
///                return through 0.055 mmHg s/mL: what sedated dogs keep of their output at 10 mmHg round the heart
///   lungs        venous compliance 8.4 -> 14 mL/mmHg: pulsus
///   reflex       resistance 0.014 (four beds of 0.05 PRU) -> 0.022, contractility 0.012 per mmHg: mean pressure within
///                10 % while output is down by a quarter
///   left side    source resistance 1e-3 s/mL and inertance: peak flow of 450 mL/s; Z, C as in the windkessel before
#include <array>

#include "core/base/fields.h"
#include "core/base/units.h"
#include "vascular/heart/compressions.h"

namespace ostium::vascular {

struct VentricleModel {
  double elastance_Pa_m3 = 0;  ///< E, of full contraction
  double unstressed_m3 = 0;    ///< V0
  double passive_Pa = 0;       ///< P1
  double stiffening_1_m3 = 0;  ///< l
};

struct BaroreflexModel {
  double scale_Pa = 18 * units::mmHg;  ///< s
  double averaging_s = 1.5;            ///< of the pressure that the receptors report [estimate: a beat or two]
  // Per mmHg of x. Heldt: 9 + 9 ms, 5 + 2 + 13 + 7 mL.
  double vagal_s_Pa = 0.009 / units::mmHg, sympathetic_s_Pa = 0.009 / units::mmHg;
  double resistance_1_Pa = 0.022 / units::mmHg;  ///< share of the resistance at rest; moved
  double veins_m3_Pa = 27 * units::mL / units::mmHg;
  double contractility_1_Pa = 0.012 / units::mmHg;  ///< share of the elastances [estimate]
  // Delay and time constant of each (Ursino).
  double vagal_after_s = 0.2, vagal_in_s = 1.5;
  double sympathetic_after_s = 2, sympathetic_in_s = 2;
  double resistance_after_s = 2, resistance_in_s = 6;
  double contractility_after_s = 2, contractility_in_s = 8;
  double veins_after_s = 5, veins_in_s = 20;
  /// Heart period that resting vagal tone adds: full block takes the rate from 70 to 100 [atropine, usual effect].
  double vagal_tone_s = 0.25;
  double reaction_passes_s = 150;  ///< time constant of a vagal reaction that is left to itself [estimate: minutes]
};

struct CirculationModel {
  VentricleModel left{2.88 * units::mmHg / units::mL, 0, 0.1203 * units::mmHg, 0.033 / units::mL};
  VentricleModel right{0.585 * units::mmHg / units::mL, 0, 0.30 * units::mmHg, 0.023 / units::mL};
  double pericardium_Pa = 0.5003 * units::mmHg, pericardium_1_m3 = 0.034 / units::mL,
         pericardium_m3 = 180 * units::mL;  ///< P0, lambda, V0
  double chest_Pa = -2 * units::mmHg;       ///< P_chest, breathed out
  double breath_Pa = -8 * units::mmHg;      ///< what a full breath adds to it
  double resistance_Pa_s_m3 = 1.26e8;       ///< of the systemic vessels
  double arteries_m3_Pa = 1.27e-8;          ///< their compliance: 1.7 mL/mmHg
  double impedance_Pa_s_m3 = 5.3e6;         ///< of the aorta: 0.04 mmHg s/mL
  double source_s_m3 = 1e-3 / units::mL;    ///< k: share of the left ventricle's pressure that ejection costs
  double aortic_valve_Pa_s_m3 = 0.018 * units::mmHg / units::mL;
  double inertance_Pa_s2_m3 = 0.0005 * units::mmHg / units::mL;  ///< of the blood in the aortic root
  double shuts_m3 = 1.5 * units::mL;                             ///< what flows back before the aortic valve is shut
  double mitral_Pa_s_m3 = 0.0158 * units::mmHg / units::mL;
  double tricuspid_Pa_s_m3 = 0.0237 * units::mmHg / units::mL;
  double pulmonary_valve_Pa_s_m3 = 0.02 * units::mmHg / units::mL;
  double lungs_Pa_s_m3 = 0.08 * units::mmHg / units::mL;
  double lung_arteries_m3_Pa = 4.3 * units::mL / units::mmHg, lung_veins_m3_Pa = 14 * units::mL / units::mmHg;
  double veins_m3_Pa = 30 * units::mL / units::mmHg;
  double constricted_m3 = 250 * units::mL;  ///< out of the veins, by a drug that doubles the resistance [estimate]
  double venous_return_Pa_s_m3 = 0.055 * units::mmHg / units::mL;          ///< from small veins to the right atrium
  double left_kick_Pa = 6 * units::mmHg, right_kick_Pa = 3 * units::mmHg;  ///< of the atria
  BaroreflexModel reflex;
  CompressionModel compressions;
};

/// What comes from outside, in a step.
struct CirculationInputs {
  double phase = 0;          ///< of the heart, at the end of the step
  double contraction = 1;    ///< [0, ..): of both ventricles, relative to rest: drugs, or a heart that does not beat
  double left_lost = 0;      ///< [0, 1]: share of the left ventricle's muscle that does not contract
  double right_lost = 0;     ///< [0, 1]: of the right ventricle's
  double dilation = 0;       ///< [0, 1]: of systemic arterioles, by drugs: 1 takes half the resistance off
  double constriction = 0;   ///< of them, by drugs: share added to the resistance
  double breath = 0;         ///< [0, 1]: depth
  double pressed_Pa = 0;     ///< on the heart, by a hand's compression
  double leak_m3_s = 0;      ///< from the arteries into the pericardium
  double drain_m3_s = 0;     ///< from the pericardium out of the body
  double drawn_m3_s = 0;     ///< from the arteries out of the body, through a catheter
  double infusion_m3_s = 0;  ///< into the veins, from outside
  double resting_rate_1_min = 70;
  double vagal_block = 0;  ///< [0, 1]: by atropine
  double rate_effect = 0;  ///< share that drugs add to the rate
  bool reflexes = false;   ///< of a person; without: an isolated circulation, which keeps its rate
};

inline constexpr double heard_every_s = 0.04;
inline constexpr int heard_count = 128;  ///< 5.12 s of what the receptors reported

struct CirculationState {
  // A person at rest, at 70 beats a minute, at the R wave.
  double left_m3 = 1.29341e-4, right_m3 = 1.11292e-4;      ///< in the ventricles
  double arteries_m3 = 1.36217e-4, veins_m3 = 3.25821e-4;  ///< beyond what fills them without pressure
  double lung_arteries_m3 = 4.30464e-5, lung_veins_m3 = 1.01441e-4;
  double pericardium_m3 = 0;                            ///< fluid in it
  double infused_m3 = 0, drained_m3 = 0, drawn_m3 = 0;  ///< so far, as the inputs of these names say
  double venous_tone_m3 = 0;  ///< unstressed volume that reflex and drugs have mobilised into `veins_m3`
  double aortic_m3_s = 0;     ///< through the aortic valve; negative while it shuts
  double back_m3 = 0;         ///< has flowed back in this beat
  bool open = false;          ///< the aortic valve is
  double left_Pa = 1474, pericardium_Pa = 0, venous_Pa = 1448;  ///< of the last step
  double mean_Pa = 12364;                                       ///< arterial pressure, averaged
  double set_Pa = 12364;                                        ///< what the reflex defends
  std::array<float, heard_count> heard_Pa{};                    ///< x, one every heard_every_s
  int heard_at = 0;
  double heard_s = 0;  ///< since the last of them
  double vagal_Pa = 0, sympathetic_Pa = 0, resistance_Pa = 0, contractility_Pa = 0, veins_Pa = 0;  ///< x as each acts
  /// [0, 1]: of a vagal reaction, in which the reflex is turned round: by this share it acts as it would at a pressure
  /// far too high, x = -s pi / 2. Atropine gives back the rate alone; the vessels stay wide until it has passed.
  double vagal_reaction = 0;
  double rate_1_min = 70;  ///< that the sinus node now has
};
constexpr auto fields(const CirculationState*) {
  using S = CirculationState;
  return std::tuple{core::field("left_m3", &S::left_m3),
                    core::field("right_m3", &S::right_m3),
                    core::field("arteries_m3", &S::arteries_m3),
                    core::field("veins_m3", &S::veins_m3),
                    core::field("lung_arteries_m3", &S::lung_arteries_m3),
                    core::field("lung_veins_m3", &S::lung_veins_m3),
                    core::field("pericardium_m3", &S::pericardium_m3),
                    core::field("infused_m3", &S::infused_m3),
                    core::field("drained_m3", &S::drained_m3),
                    core::field("drawn_m3", &S::drawn_m3),
                    core::field("venous_tone_m3", &S::venous_tone_m3),
                    core::field("aortic_m3_s", &S::aortic_m3_s),
                    core::field("back_m3", &S::back_m3),
                    core::field("open", &S::open),
                    core::field("left_Pa", &S::left_Pa),
                    core::field("pericardium_Pa", &S::pericardium_Pa),
                    core::field("venous_Pa", &S::venous_Pa),
                    core::field("mean_Pa", &S::mean_Pa),
                    core::field("set_Pa", &S::set_Pa),
                    core::field("heard_Pa", &S::heard_Pa),
                    core::field("heard_at", &S::heard_at),
                    core::field("heard_s", &S::heard_s),
                    core::field("vagal_Pa", &S::vagal_Pa),
                    core::field("sympathetic_Pa", &S::sympathetic_Pa),
                    core::field("resistance_Pa", &S::resistance_Pa),
                    core::field("contractility_Pa", &S::contractility_Pa),
                    core::field("veins_Pa", &S::veins_Pa),
                    core::field("vagal_reaction", &S::vagal_reaction),
                    core::field("rate_1_min", &S::rate_1_min)};
}

/// Advances by `dt_s`, up to 10 ms, in parts of at most 2 ms.
void step(const CirculationModel& model, const CirculationInputs& inputs, double dt_s, CirculationState& state);

/// From now on the reflex defends the pressure that there is, as it does after hours. For a circulation that has run
/// without it.
void settle_reflex(CirculationState& state);

/// Blood in the body and in the pericardium beyond what fills vessels without pressure, less what came from outside and
/// what the reflex mobilised: constant.
double conserved_m3(const CirculationState& state);

/// Share of a ventricle's contraction, by phase: rises to end-systole and is gone half as long after it (Heldt).
double contraction_share(double phase);

}  // namespace ostium::vascular
