#pragma once
/// Treatment of the arteries: balloons, stents, the wall under them, injuries, drugs. Stepped before the physiology
/// (physiology.h), whose radii and occupied lumen it sets.
#include "vascular/physiology/physiology.h"
#include "vascular/treatment/carina.h"
#include "vascular/treatment/drugs.h"
#include "vascular/treatment/injury.h"
#include "vascular/treatment/stent_shape.h"
#include "vascular/treatment/thrombus.h"

namespace ostium::vascular {

struct TreatmentModel {
  PlaqueModel plaque;
  InjuryModel injury;
  ThrombusModel thrombus = {};
  DrugModel drugs;
  std::vector<BalloonModel> balloons;  ///< all that may be used
  std::vector<StentModel> stents;      ///< likewise
  std::vector<int> stent_on;           ///< (#balloons) stent crimped on it, or -1
  std::vector<VesselPath> paths;       ///< all_paths of the flow tree
  std::vector<Fork> forks = {};        ///< whose carinas move and where stents' cells open; may be none
};

/// A complication that a trainer asks for.
enum class Provoked { nothing, perforation, dissection, spasm, no_reflow, fibrillation, block, thrombus, air, vagal };
inline constexpr int provocations = 10;
inline constexpr const char* provocation_names[provocations] = {
    "nothing", "perforation", "dissection", "spasm", "no-reflow",
    "VF",      "AV block",    "thrombus",   "air",   "vagal reaction"};

struct Provocation {
  Provoked kind = Provoked::nothing;
  int cell = -1;  ///< of the flow tree; not for rhythms and reactions, nor for air, which is in the line
  /// Hole's diameter, m; grade of a dissection, 0 to 5; share taken by spasm or no-reflow, [0, 1); volume, m3, of
  /// thrombus or air; share of the strongest reaction.
  double size = 0;
};

inline constexpr int most_balloons = 2;  ///< in the body at a time, each on its own inflation device

/// A balloon in the body.
struct PlacedBalloon {
  int balloon = -1;  ///< index of the balloon in the vessel; -1: none. A new one starts deflated
  int branch = -1;   ///< branch whose path contains it (from cell_locator.h); -1: not in the coronaries
  ShaftPlace shaft;  ///< of it along that path
  double gauge_Pa = 0;
  double drag_N = 0;  ///< StentInputs
};

struct TreatmentInputs {
  std::array<PlacedBalloon, most_balloons> balloons = {};
  double edge_m = -1e9, edge_N = 0;      ///< StentInputs
  int wire_tip_cell = -1;                ///< where a wire presses against the wall
  double wire_tip_N = 0;                 ///< and its force
  std::span<const double> shaft_m = {};  ///< (#cells) radius of other instruments in the lumen; empty: none
  Doses doses = {};
  Provocation provocation = {};
  double shock_J = 0;                         ///< a defibrillator's, in this step
  TipPlace tip = {};                          ///< of the guide
  double tip_covered = 0, injected_m3_s = 0;  ///< TipPressureInputs; through its tip
  double drawn_m3_s = 0;                      ///< through it
};

struct TreatmentState {
  PlaqueState wall;
  std::array<BalloonState, most_balloons> balloons;
  std::array<int, most_balloons> balloon_in{-1, -1};  ///< index in the model; -1: none yet
  std::vector<StentState> stents;                     ///< (#stents), including crimped ones
  std::vector<double> carina_m;  ///< (#forks) how far it lies in the side branch's mouth (carina.h)
  /// (#forks) Plaque pushed so far, and what of it lies in the side branch's mouth (plaque_shift.h).
  std::vector<double> pushed_m3, in_mouth_m3;
  std::vector<double> spasm;  ///< (#branches) [0, 1): of the diameter; may be set from outside
  InjuryState injury;
  ThrombusState thrombus;
  DrugState drugs;
  int shocks = 0;  ///< given so far
};
constexpr auto fields(const TreatmentState*) {
  using S = TreatmentState;
  return std::tuple{core::field("wall", &S::wall),
                    core::field("balloons", &S::balloons),
                    core::field("balloon_in", &S::balloon_in),
                    core::field("stents", &S::stents),
                    core::field("carina_m", &S::carina_m),
                    core::field("pushed_m3", &S::pushed_m3),
                    core::field("in_mouth_m3", &S::in_mouth_m3),
                    core::field("spasm", &S::spasm),
                    core::field("injury", &S::injury),
                    core::field("drugs", &S::drugs),
                    core::field("shocks", &S::shocks),
                    core::field("thrombus", &S::thrombus)};
}
TreatmentState make_state(const TreatmentModel& model, const FlowTree& tree);

struct TreatmentScratch {
  BalloonScratch balloon;
  StentScratch stent;
  std::vector<double> beside_m, lumen_m;  ///< (balloon_spheres) of what lies beside the balloon that is stepped
  std::vector<Eigen::Vector2d> beside_aside_m;
};

struct TreatmentReport {
  std::array<BalloonReport, most_balloons> balloons;
  std::array<bool, most_balloons> blocked{};  ///< an unopened stent is in the balloon's way
  bool tore = false;                          ///< an injury occurred in this step
};

/// What leaks out of all holes, m3/s.
double leak_m3_s(const TreatmentState& state);

/// What a treatment changes: `physiology`'s radii, contrast that leaves through injuries, rhythm, lost muscle, air in
/// the line; sets `occupied_m` (#cells) to the radius of everything in the lumen besides blood.
struct TreatedVessels {
  const FlowModel& flow;
  PhysiologyState& physiology;
  std::vector<double>& occupied_m;
};

/// One step of up to 10 ms. Does not allocate after the first call with the same scratch.
TreatmentReport step(const TreatmentModel& model, const TreatmentInputs& inputs, double dt_s, TreatmentState& state,
                     const TreatedVessels& vessels, TreatmentScratch& scratch);

}  // namespace ostium::vascular
