#pragma once
/// Blood flow in the coronary tree: Poiseuille in every cell, losses behind narrowings, myocardium at the ends.
///
///   p_up - p = R Q + B Q |Q|,   R = 8 mu L / (pi r^4),   in an annulus around a shaft of radius a (Bird, Stewart,
///       Lightfoot, eq. 2.4-17)   R = 8 mu L / (pi (r^4 - a^4 - (r^2 - a^2)^2 / ln(r / a)))
///   B = K_t rho / 2 (1 / A_s - 1 / A)^2, K_t = 1.52, summed over an expansion from a throat A_s (Young, Tsai 1973, J
///       Biomech 6:395, their separation loss; A in the place of the unobstructed area)
///   flow into the myocardium:  Q = g (p - p_z),   p_z = max(zero flow pressure, squeeze x p_ventricle)
///
/// One law for all vessels gives each cell's need at rest: flow is proportional to the diameter to the power 2.6, with
/// 225 mL/min in total (Guyton). This exponent is fitted, not published: Murray's is 3, Huo's and Kassab's 7/3,
/// measured ones are 2.15 and 2.38 (Taylor et al. 2022, Front Physiol 13:871912, of 27 human arteries, r = 0.47 and
/// 0.66). With 2.6 the TIMI frame counts of all three arteries match published ones (36.2, 22.2, 20.4). With 7/3 they
/// are 41.0, 19.6, 18.3, the LAD's off by more than a deviation; with 3 they are 27.8, 27.2, 20.7, with LAD and LCx
/// off. Flow that a taper loses beyond the modelled side branches leaves along its length. The myocardium dilates until
/// its need is met, at most by `most_dilated`. Walls are rigid within a step: no capacitance.
#include <array>
#include <span>

#include "vascular/flow/flow_tree.h"

namespace ostium::vascular {

struct FlowModel {
  FlowTree tree;
  double viscosity_Pa_s = 3.5e-3;      ///< of blood (Hund 2017)
  double density_kg_m3 = 1055;         ///< of blood
  double separation = 1.52;            ///< K_t
  double zero_flow_Pa = 20 * 133.322;  ///< pressure behind a closed balloon without collaterals: 20 to 30 mmHg
  /// Share of the ventricle's pressure that compresses the myocardial vessels: the diastolic to systolic ratio of
  /// velocity is 1.8 to 2.1 in the left coronary, 1.0 in the right (Hadjiloizou 2008).
  std::array<double, territories> squeeze = {0.60, 0.50, 0.27};
  double most_dilated = 3.4;  ///< largest conductance of the muscle relative to rest (flow reserve 3.0 to 3.25)
  double averaging_s = 1.5, tone_s = 8;  ///< autoregulation [estimate: reactive hyperaemia lasts tens of seconds]
  std::vector<double> need_m3_s;         ///< (#cells) at rest
  std::vector<double> leak_m3_sPa;       ///< (#cells) g at rest
};

/// `total_m3_s`: both coronaries at rest.
FlowModel make_flow_model(FlowTree tree, double total_m3_s = 225e-6 / 60);

struct FlowInputs {
  Pressures pressures;
  std::span<const double> radius_m;    ///< (#cells) of the lumen
  std::span<const double> occupied_m;  ///< (#cells) radius of an instrument in it; empty: none
  double hyperaemia = 0;               ///< [0, 1]: adenosine dilates the myocardial vessels regardless of need
  std::span<const double> open = {};   ///< (#branches) share of the muscle's arterioles without air; empty: all
};

struct FlowState {
  std::vector<double> flow_m3_s;    ///< (#cells) through the upstream face, away from the heart
  std::vector<double> pressure_Pa;  ///< (#cells) at its middle
  std::vector<double> leak_m3_s;    ///< (#cells) into the myocardium, or out of the modelled tree
  std::vector<double> tone;         ///< (#branches) conductance of the myocardium relative to rest
  std::vector<double> mean_m3_s;    ///< (#branches) leak, averaged
  std::vector<double> no_reflow;    ///< (#branches) [0, 1): lost share of the myocardium's conductance
};
constexpr auto fields(const FlowState*) {
  using S = FlowState;
  return std::tuple{core::field("flow_m3_s", &S::flow_m3_s), core::field("pressure_Pa", &S::pressure_Pa),
                    core::field("leak_m3_s", &S::leak_m3_s), core::field("tone", &S::tone),
                    core::field("mean_m3_s", &S::mean_m3_s), core::field("no_reflow", &S::no_reflow)};
}
FlowState make_flow_state(const FlowModel& model);

struct FlowScratch {
  std::vector<double> R, E, G, S, g, pz;
};

/// One step of up to 10 ms. Linear in the cells; does not allocate after the first call with the same scratch.
void step(const FlowModel& model, const FlowInputs& inputs, double dt_s, FlowState& state, FlowScratch& scratch);

/// Ratio of flow to need in each territory.
std::array<double, territories> supply(const FlowModel& model, const FlowState& state);

/// Fractional flow reserve at a cell, labelled `model` wherever it is shown: its pressure over the aorta's, at a mean
/// pressure of 93 mmHg and full hyperaemia.
double ffr_model(const FlowModel& model, std::span<const double> radius_m, int cell);

/// Cross-section free for blood, m2.
double free_area_m2(double radius_m, double occupied_m);

}  // namespace ostium::vascular
