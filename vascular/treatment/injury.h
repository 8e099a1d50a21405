#pragma once
/// Injury as a hazard: which wall tears cannot be predicted, only with what probability.
///
/// The treatment of a location amounts to a hazard H, and the wall tears once H exceeds -ln u, with u drawn by the
/// seed, so that the probability is 1 - exp(-H). If stretched to the ratio x of its healthy size:
///   dissection   H = 0.36 e^(7 (x - 1)) (1 + 0.8 calcified) (1 + 0.4 eccentric) sqrt(length / 15 mm)
///   perforation  H = 0.0002 e^(20 (x - 1)) (1 + calcified)
/// At a ratio of 1, some dissection is seen in 30 % of balloon angioplasties, of which a third are major (9 %), and the
/// probability rises above 1.1; perforation by a balloon occurs almost only above 1.3 (Kataoka 2010). A wire's tip
/// perforates by force and time, sooner in smaller arteries. The coefficients are fitted to these rates.
///
/// A perforation is a hole of an area drawn by the seed (Ellis III by definition from about 1 mm on; what effectively
/// bleeds is less), from 0.2 to 1.2 mm in diameter, through which blood leaves by the orifice law
///   Q = 0.6 A sqrt(2 dp / rho):  1 mm at 80 mmHg 2.1 mL/s
/// driven by the pressure in its artery over that in the pericardium. It clots: sooner the smaller it is, the less
/// heparin acts, and while a balloon or a covered stent lies over it. A balloon alone seals 54.5 % of Ellis III
/// (Al-Lamee 2011, JACC Cardiovasc Interv 4:87); which, the seed decides.
///
/// A dissection's flap takes part of the lumen's area, in time, as far as no stent holds it: A none, B a tenth, C what
/// the seed draws up to 35 %, D and E half, F nearly all (A and B leave flow reserve as it was, C lowers it, F stops
/// flow: DEBATE, Am J Cardiol 2000;86:375; the shares are estimates).
///
/// A guide whose end hole lies against a wall, or fills the artery, tears it by what is injected at 3 mL/s and more:
///   H = 0.012 per mL
/// (0.12 % of interventions; 2.3 % have a damped trace, and not all inject: 4 mL in all of them would be 0.11 %). Such
/// a jet also makes dissections run on, by 3 mm and 6 % of the lumen per mL; that of an open guide in the same artery
/// by a quarter of it. [estimates] Where a stent holds the flap, it stays.
#include <array>
#include <cstdint>

#include "vascular/treatment/plaque.h"

namespace ostium::vascular {

struct InjuryModel {
  std::uint64_t seed = 0;
  /// Tip force that a wall of 0.5 mm radius withstands for long [estimate: wires made to pierce a plaque's cap, 12 gf
  /// at a tip of 0.23 mm, press with 2.8 MPa; one of 0.36 mm does so with 0.28 N, and a wall withstands less than a
  /// cap].
  double wire_N = 0.2;
};

enum class InjuryKind { none, dissection, perforation };

struct Injury {
  InjuryKind kind = InjuryKind::none;
  int cell = -1;  ///< of the flow tree
  int grade = 0;  ///< dissection 0 to 5: A to F; perforation 1 to 3: Ellis I to III, 5: V (distal, by a wire)
  double time_s = 0;
  double outside_kg = 0, outside_m3 = 0;  ///< iodine and volume outside the lumen
  double hole_m2 = 0;                     ///< of a perforation, before it clots
  double clotted = 0;                     ///< [0, 1]: share of it that has
  double clots_at_most = 1;               ///< [0, 1]: while heparin acts
  bool covered = false;                   ///< a balloon or a covered stent lies over it
  double leak_m3_s = 0;                   ///< now
  double narrows = 0;                     ///< [0, 1): share of the lumen's area that a flap takes, now
  double will_narrow = 0;                 ///< and in the end
  double runs_m = 0;                      ///< how far a flap has run on distally, beyond its first length
};
constexpr auto fields(const Injury*) {
  using S = Injury;
  return std::tuple{core::field("kind", &S::kind),
                    core::field("cell", &S::cell),
                    core::field("grade", &S::grade),
                    core::field("time_s", &S::time_s),
                    core::field("outside_kg", &S::outside_kg),
                    core::field("outside_m3", &S::outside_m3),
                    core::field("hole_m2", &S::hole_m2),
                    core::field("clotted", &S::clotted),
                    core::field("clots_at_most", &S::clots_at_most),
                    core::field("covered", &S::covered),
                    core::field("leak_m3_s", &S::leak_m3_s),
                    core::field("narrows", &S::narrows),
                    core::field("will_narrow", &S::will_narrow),
                    core::field("runs_m", &S::runs_m)};
}
inline constexpr int most_injuries = 8;

struct InjuryState {
  std::array<Injury, most_injuries> injuries;
  int count = 0;
  double dissection_H = 0, perforation_H = 0, wire_H = 0, jet_H = 0;  ///< hazards so far
  int dissection_draws = 0, perforation_draws = 0, wire_draws = 0, jet_draws = 0;
};
constexpr auto fields(const InjuryState*) {
  using S = InjuryState;
  return std::tuple{core::field("injuries", &S::injuries),
                    core::field("count", &S::count),
                    core::field("dissection_H", &S::dissection_H),
                    core::field("perforation_H", &S::perforation_H),
                    core::field("wire_H", &S::wire_H),
                    core::field("jet_H", &S::jet_H),
                    core::field("dissection_draws", &S::dissection_draws),
                    core::field("perforation_draws", &S::perforation_draws),
                    core::field("wire_draws", &S::wire_draws),
                    core::field("jet_draws", &S::jet_draws)};
}

/// Probability that a hazard has caused an injury, [0, 1].
double chance(double hazard);
double dissection_hazard(double ratio, bool calcified, bool eccentric, double length_m);
double perforation_hazard(double ratio, bool calcified);

/// Evaluates how far each cell was stretched; `length_m`: of the balloon; `burst`: it burst in this step.
void judge_stretch(const InjuryModel& model, const PlaqueModel& plaque, const PlaqueState& wall, double length_m,
                   bool burst, double time_s, InjuryState& state);
/// A wire's tip against the wall of a cell. `tip_N`: resultant of the wall forces on the tip, which equals the push of
/// the wire behind it. Opposing walls between which a bend is wedged cancel: they are widened, not pierced.
void judge_wire(const InjuryModel& model, int cell, double radius_m, double tip_N, double dt_s, double time_s,
                InjuryState& state);

/// What is injected through a guide.
struct GuideJet {
  int cell = -1;            ///< of the flow tree, where it enters; -1: not into an artery
  double m3_s = 0;          ///< through the tip
  double against_wall = 0;  ///< [0, 1]: the end hole lies against a wall, or fills the artery
};
void judge_jet(const InjuryModel& model, const GuideJet& jet, double dt_s, double time_s, InjuryState& state);
/// Lets a dissection that no stent holds run on. `downstream`: it lies in the artery that the jet enters.
void run_on(const GuideJet& jet, bool downstream, double dt_s, Injury& injury);

/// An injury from outside: a provocation. `size`: of a perforation the hole's diameter, m; of a dissection unused.
void injure(const InjuryModel& model, InjuryKind kind, int cell, int grade, double size_m, double time_s,
            InjuryState& state);

/// Leakage from the lumen through an injury, m3/s, by the pressure across it; none while it is covered.
double leak_m3_s(const Injury& injury, double across_Pa);
/// Clotting and narrowing over a step. `act_s`: activated clotting time.
void age(double act_s, double dt_s, Injury& injury);
/// Volume of its false lumen, m3.
double pocket_m3(const Injury& injury);
const char* grade_name(const Injury& injury);

}  // namespace ostium::vascular
