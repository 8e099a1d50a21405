#pragma once
/// The wall of the coronary arteries under a balloon, cell by cell: elastic, then yielding.
///
///   p(a) = E (a - rest) / healthy + p_m (exp(k ((a / healthy)^2 - 1)) - 1)      pressure at a radius a > rest
/// E increases from that of a healthy artery (distensibility 1.1 to 2.4e-3 /mmHg) to the plaque's; the exponential is
/// media and adventitia, which resist beyond the healthy size. The first term yields at
///   p_y = yield (1 - weakening broken) + hardening x,      x = (rest - diseased) / (healthy - diseased)
/// whereupon `rest` grows: the plaque cracks, then opens at less pressure, and when the balloon is removed the opening
/// remains, less the elastic part (recoil). The plaque's numbers are estimates: waists yield at 4 to 6 atm if soft, at
/// 8 to 12 if calcified, and the recoil of a stented wall is as published (5 to 9 %).
#include "vascular/flow/flow_tree.h"

namespace ostium::vascular {

struct PlaqueLaw {
  double healthy_Pa = 1.5 * 101325;                          ///< E without plaque
  double media_Pa = 0.05 * 101325, media_k = 5;              ///< p_m, k
  double soft_Pa = 32 * 101325, calcified_Pa = 75 * 101325;  ///< E of plaque that narrows by 30 % or more
  double soft_yield_Pa = 4.2 * 101325, calcified_yield_Pa = 9 * 101325;
  double weakening = 0.6;
  double soft_hardening_Pa = 2.2 * 101325, calcified_hardening_Pa = 4.2 * 101325;
  double crack = 0.12;  ///< share of the opening over which it breaks
};

struct PlaqueCell {
  double diseased_m = 0, healthy_m = 0;
  double E_Pa = 0, yield_Pa = 0, hardening_Pa = 0;
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
  std::vector<double> peak_m;    ///< (#cells) largest radius so far
  std::vector<double> radius_m;  ///< (#cells) current radius: rest, or more where a balloon or stent holds it open
};
constexpr auto fields(const PlaqueState*) {
  return std::tuple{core::field("rest_m", &PlaqueState::rest_m), core::field("broken", &PlaqueState::broken),
                    core::field("peak_m", &PlaqueState::peak_m), core::field("radius_m", &PlaqueState::radius_m)};
}
PlaqueState make_plaque_state(const PlaqueModel& model);

struct WallPressure {
  double p_Pa = 0, slope_Pa_m = 0;  ///< at a radius, and its slope
};
/// Pressure of the wall at a radius, without changing it.
WallPressure wall_pressure(const PlaqueModel& model, const PlaqueState& state, int cell, double radius_m);
/// Pushes the wall of a cell to a radius, yielding where necessary; `radius_m` becomes the larger of that and `rest_m`.
void push_wall(const PlaqueModel& model, int cell, double radius_m, PlaqueState& state);

}  // namespace ostium::vascular
