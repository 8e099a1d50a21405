#pragma once
/// The wall of the coronary arteries under a balloon, cell by cell: elastic, then yielding.
///
///   p(a) = E_s (min(a, open) - rest) / healthy + E (a - open) / healthy          pressure at a radius a > rest,
///          + p_m (exp(k ((a / healthy)^2 - 1)) - 1)                               terms where a > open, a > healthy
/// E increases from that of a healthy artery (distensibility 1.1 to 2.4e-3 /mmHg) to the plaque's; the exponential is
/// media and adventitia, which resist beyond the healthy size. The plaque yields at
///   p_y = yield (1 - weakening broken) + hardening x / free,      x = (open - diseased) / (healthy - diseased)
/// and always at the same strain, so that E grows with p_y. Then `open` grows: the plaque cracks, opens at less
/// pressure at first and at more the farther it is open. When the balloon is removed, that strain springs back at once;
/// and of the opening itself a share, softly (E_s), as the stretched wall around it closes again,
///   rest = diseased + (1 - spring_back) (open - diseased)
/// unless a stent holds it: recoil after plain balloons takes 23 % of the gain (Rozenman et al., Am J Cardiol 1993, 696
/// lesions), in stents 5 to 9 % of the diameter. `free` falls with the calcium's arc, since the rest of the wall
/// stretches more than what lies behind calcium,
///   free = 1 - calcium_holds arc / (2 pi)
/// Calcium of more than half the wall is a ring under p a / t; where that exceeds its strength it breaks, and the whole
/// wall is free again. Smaller pieces hardly ever break (Zhu et al., PLOS ONE 2021;16:e0251404).
///
/// The constants were fitted by hand in persons 1 to 8 of five cases: after its delivery balloon a stent's minimal
/// diameter is 27.2 +- 7.2 % below the balloon's chart (Aziz et al., Heart 2007;93:1562; 499 lesions); its recoil, 5 to
/// 9 %, and its expansion after postdilatation, median 72.8 %, quartiles 63 and 81 (ILUMIEN II), were looked at, too.
/// The gate has other persons. Calcium's strength is an estimate.
#include "vascular/flow/flow_tree.h"

namespace ostium::vascular {

struct PlaqueLaw {
  double healthy_Pa = 1.5 * 101325;                     ///< E without plaque
  double media_Pa = 0.05 * 101325, media_k = 5;         ///< p_m, k
  double yield_Pa = 4.2 * 101325, yield_strain = 0.08;  ///< of plaque that narrows by 30 % or more
  double weakening = 0.4;
  double crack = 0.12;                ///< share of the opening over which it breaks
  double hardening_Pa = 14 * 101325;  ///< of the typical plaque, all of it free
  double calcium_Pa = 2.4e6;          ///< a ring's strength: 0.5 mm in a lumen of 2.4 mm breaks at 10 atm
  double spring_back = 0.2, spring_Pa = 7 * 101325;  ///< and E_s: about 1 atm holds all of it, as a stent can
  double calcium_holds = 0.6;  ///< as a full ring [estimate: 180 degrees cost a fifth of the expansion, Fujino 2018]
};

struct PlaqueCell {
  double diseased_m = 0, healthy_m = 0;
  double E_Pa = 0, yield_Pa = 0, hardening_Pa = 0;  ///< of the plaque as it is found
  double calcium_arc_share = 0, calcium_m = 0;      ///< of the circumference, [0, 1]; thickness
  bool calcified = false, eccentric = false;
};

struct PlaqueModel {
  PlaqueLaw law;
  std::vector<PlaqueCell> cells;
};
PlaqueModel make_plaque_model(const FlowTree& tree, const std::vector<Lesion>& lesions, const PlaqueLaw& law = {});

struct PlaqueState {
  std::vector<double> rest_m;    ///< (#cells) unloaded radius
  std::vector<double> broken;    ///< (#cells) [0, 1]
  std::vector<double> cracked;   ///< (#cells) 1 where the calcium is broken, else 0
  std::vector<double> peak_m;    ///< (#cells) largest radius so far
  std::vector<double> radius_m;  ///< (#cells) current radius: rest, or more where a balloon or stent holds it open
};
constexpr auto fields(const PlaqueState*) {
  return std::tuple{core::field("rest_m", &PlaqueState::rest_m), core::field("broken", &PlaqueState::broken),
                    core::field("cracked", &PlaqueState::cracked), core::field("peak_m", &PlaqueState::peak_m),
                    core::field("radius_m", &PlaqueState::radius_m)};
}
PlaqueState make_plaque_state(const PlaqueModel& model);

struct WallPressure {
  double p_Pa = 0, slope_Pa_m = 0;  ///< at a radius, and its slope
};
/// A cell's law at its state, for many radii; names as above.
struct WallLaw {
  double healthy_m = 0, rest_m = 0, open_m = 0;
  double E_s_Pa = 0, E_Pa = 0, open_Pa = 0, yield_Pa = 0;  ///< open_Pa: pressure at open_m
  double media_Pa = 0, media_k = 0;
  WallPressure at(double radius_m) const;
};
WallLaw wall_law(const PlaqueModel& model, const PlaqueState& state, int cell);
/// Pressure of the wall at a radius, without changing it.
WallPressure wall_pressure(const PlaqueModel& model, const PlaqueState& state, int cell, double radius_m);
/// Pushes the wall of a cell to a radius, yielding where necessary; `radius_m` becomes the larger of that and `rest_m`.
void push_wall(const PlaqueModel& model, int cell, double radius_m, PlaqueState& state);

}  // namespace ostium::vascular
