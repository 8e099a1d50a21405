#pragma once
/// Thrombus in an artery: it forms on what lies in the blood, grows, is pressed on by a balloon, and is drawn out
/// through a guide.
///
///   forms     by a hazard, per minute, of the activated clotting time (ACT) and of how the blood stands there:
///             (0.03 at 130 s, which is without heparin, 0.01 at 150 s, 0.002 at 200 s, 0 from 250 s on) (1 + 2 s)
///   stands    s = exp(-|u| / 5 cm/s), u the mean speed of the blood beside it
///   grows     dV/dt = 0.04 mm3/s (hazard / 0.03) (1 + 4 s) until it fills the lumen: 17 minutes in flowing blood
///   without
///             heparin, 4 in standing blood (arteries close a median of 27 minutes after the first inflation, Lincoff
///             1992, JACC 19:926)
///   embolises what a balloon or a shaft leaves no room for goes on with the blood: half as a lump, to where the lumen
///   is
///             narrower than it or divides, half as dust into the muscle, which it closes as no-reflow does:
///             lost = 1 - exp(-V / (5 mm3 s/mL Q)), Q its flow at rest
///   aspirated dV/dt = -(V - firm) (q / 4 mL/s) exp(-d / 10 mm) / 4 s; q: blood drawn, which the guide's lumen decides,
///             d: distance from its tip. A share of it is firm, 0.25 to 0.75 by the seed: 48 +- 23 to 59 +- 27 % of the
///             mass is removed (J Cardiovasc Dev Dis 2023;10:69)
///
/// All rates but those with a source are estimates. Heparin keeps it from growing and does not dissolve it.
#include <array>
#include <cstdint>
#include <span>

#include "vascular/contrast/contrast.h"

namespace ostium::vascular {

struct ThrombusModel {
  std::uint64_t seed = 0;
  double grows_m3_s = 0.04e-9;
  double seed_m3 = 1e-9;        ///< what has formed
  double length_m = 6e-3;       ///< of artery that one lies in
  double dust_s = 5e-9 / 1e-6;  ///< m3 of it that closes 1 - 1/e of a muscle, over that muscle's flow at rest
};

struct Thrombus {
  int cell = -1;  ///< of the flow tree, in its middle; -1: none
  double m3 = 0;
  double firm_m3 = 0;  ///< cannot be aspirated
};
constexpr auto fields(const Thrombus*) {
  return std::tuple{core::field("cell", &Thrombus::cell), core::field("m3", &Thrombus::m3),
                    core::field("firm_m3", &Thrombus::firm_m3)};
}
inline constexpr int most_thrombi = 8;

struct ThrombusState {
  std::array<Thrombus, most_thrombi> thrombi;
  double hazard = 0;  ///< since the last one formed
  int formed = 0;     ///< so far, provoked ones among them
  /// So far: what has grown is there, was aspirated or went as dust.
  double grown_m3 = 0, aspirated_m3 = 0, dust_m3 = 0;
  double embolised_m3 = 0;  ///< so far, as lump or dust
};
constexpr auto fields(const ThrombusState*) {
  using S = ThrombusState;
  return std::tuple{core::field("thrombi", &S::thrombi),
                    core::field("hazard", &S::hazard),
                    core::field("formed", &S::formed),
                    core::field("grown_m3", &S::grown_m3),
                    core::field("aspirated_m3", &S::aspirated_m3),
                    core::field("dust_m3", &S::dust_m3),
                    core::field("embolised_m3", &S::embolised_m3)};
}

/// What surrounds it in a step.
struct ThrombusInputs {
  double act_s = 130;
  const FlowModel& flow;
  std::span<const double> radius_m;   ///< (#cells) of the lumen
  std::span<const double> devices_m;  ///< (#cells) radius of shafts and balloons in it
  TipPlace tip;                       ///< of the guide
  double drawn_m3_s = 0;              ///< through it
};

double thrombus_hazard_1_s(double act_s);
/// How much the blood stands, [0, 1]: `s` above.
double standing(double flow_m3_s, double free_m2);

/// A thrombus of a volume at a cell, as a trainer asks for it.
void form(const ThrombusModel& model, int cell, double volume_m3, ThrombusState& state);

/// One step; dust goes into `blood.no_reflow`.
void step(const ThrombusModel& model, const ThrombusInputs& inputs, double dt_s, ThrombusState& state,
          FlowState& blood);

/// Adds what thrombus fills of each cell's lumen to `occupied_m` (#cells), the radius of all that lies in it.
void fill(const ThrombusModel& model, const FlowTree& tree, std::span<const double> radius_m,
          const ThrombusState& state, std::span<double> occupied_m);

double volume_m3(const ThrombusState& state);

}  // namespace ostium::vascular
