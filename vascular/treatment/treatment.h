#pragma once
/// What is done to the arteries: balloons, stents, the wall under them, injuries, drugs. Stepped before the physiology
/// (physiology.h), whose radii and occupied lumen it sets.
#include "vascular/physiology/physiology.h"
#include "vascular/treatment/drugs.h"
#include "vascular/treatment/injury.h"
#include "vascular/treatment/stent_shape.h"

namespace ostium::vascular {

struct TreatmentModel {
  PlaqueModel plaque;
  InjuryModel injury;
  DrugModel drugs;
  std::vector<BalloonModel> balloons;  ///< that may be used, and
  std::vector<StentModel> stents;      ///< with
  std::vector<int> stent_on;           ///< (#balloons) the stent crimped on it, or -1
  std::vector<VesselPath> paths;       ///< all_paths of the flow tree
};

struct TreatmentInputs {
  int balloon = -1;     ///< of the model, which is in the vessel; -1: none. Another one starts deflated
  int branch = -1;      ///< along whose path it lies (cell_locator.h finds it); -1: not in the coronaries
  double middle_m = 0;  ///< between its markers, along that path
  double gauge_Pa = 0;
  double drag_N = 0;                     ///< StentInputs
  double edge_m = -1e9, edge_N = 0;      ///< StentInputs
  int wire_tip_cell = -1;                ///< where a wire presses the wall, and
  double wire_tip_N = 0;                 ///< how hard
  std::span<const double> shaft_m = {};  ///< (#cells) radius of what else lies in the lumen; empty: nothing
  Doses doses = {};
};

struct TreatmentState {
  PlaqueState wall;
  BalloonState balloon;
  int balloon_in = -1;             ///< of the model; -1: none yet
  std::vector<StentState> stents;  ///< (#stents), crimped ones on a balloon in use or not
  std::vector<double> spasm;       ///< (#branches) [0, 1): of the diameter, may be set
  InjuryState injury;
  DrugState drugs;
};
constexpr auto fields(const TreatmentState*) {
  using S = TreatmentState;
  return std::tuple{
      core::field("wall", &S::wall),     core::field("balloon", &S::balloon), core::field("balloon_in", &S::balloon_in),
      core::field("stents", &S::stents), core::field("spasm", &S::spasm),     core::field("injury", &S::injury),
      core::field("drugs", &S::drugs)};
}
TreatmentState make_state(const TreatmentModel& model, const FlowTree& tree);

struct TreatmentScratch {
  BalloonScratch balloon;
  StentScratch stent;
};

struct TreatmentReport {
  BalloonReport balloon;
  int deployed = -1;     ///< a stent that was left in the wall in this step: tie it (stent_shape.h)
  bool blocked = false;  ///< the balloon cannot lie there: a stent that is not open is in its way
  bool tore = false;     ///< an injury came about in this step
};

/// What a treatment acts on: `physiology`'s radii are set and contrast goes out through injuries; `occupied_m` (#cells)
/// becomes what fills the lumen.
struct TreatedVessels {
  const FlowTree& tree;
  PhysiologyState& physiology;
  std::vector<double>& occupied_m;
};

/// One step of up to 10 ms. Does not allocate after the first call with the same scratch.
TreatmentReport step(const TreatmentModel& model, const TreatmentInputs& inputs, double dt_s, TreatmentState& state,
                     const TreatedVessels& vessels, TreatmentScratch& scratch);

}  // namespace ostium::vascular
