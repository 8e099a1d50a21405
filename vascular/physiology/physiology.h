#pragma once
/// The physiology around the instruments: heart, ischaemia, flow and contrast, as one model, one input, one state.
///
/// Called every step; the heart advances each time, blood and contrast every `circulation_step_s`.
#include "vascular/contrast/contrast.h"
#include "vascular/contrast/tip_pressure.h"
#include "vascular/flow/flow.h"
#include "vascular/heart/ecg.h"
#include "vascular/heart/heart.h"
#include "vascular/physiology/air.h"
#include "vascular/physiology/awareness.h"
#include "vascular/physiology/contrast_reaction.h"

namespace ostium::vascular {

inline constexpr double circulation_step_s = 8e-3;

struct PhysiologyModel {
  HeartModel heart;
  IschaemiaModel ischaemia;
  FlowModel flow;
  ContrastModel contrast;
  TipPressureModel line;
  AirModel air = {};
  AwarenessModel awareness = {};
  ContrastReactionModel reaction = {};
};
/// `seed`: for random events and for the person's ECG response (0: the mean).
PhysiologyModel make_physiology(const Patient& patient, std::uint64_t seed = 0);

struct PhysiologyInputs {
  HeartInputs heart;
  ContrastInputs contrast;
  std::vector<double> occupied_m;  ///< (#cells) radius of instruments in each cell; empty: none
  double hyperaemia = 0;           ///< FlowInputs
  bool tip_in_ventricle = false, wire_in_catheter = false;  ///< TipPressureInputs; the tip's position is in `contrast`
  double tip_covered = 0;
};

struct PhysiologyState {
  HeartState heart;
  IschaemiaState ischaemia;
  FlowState flow;
  ContrastState contrast;
  TipPressureState line;
  AirState air;
  AwarenessState awareness;
  ContrastReactionState reaction;
  std::vector<double> radius_m;  ///< (#cells) of the lumen
  double circulation_s = 0;      ///< since blood and contrast last advanced
};
constexpr auto fields(const PhysiologyState*) {
  using S = PhysiologyState;
  return std::tuple{core::field("heart", &S::heart),         core::field("ischaemia", &S::ischaemia),
                    core::field("flow", &S::flow),           core::field("contrast", &S::contrast),
                    core::field("line", &S::line),           core::field("air", &S::air),
                    core::field("awareness", &S::awareness), core::field("reaction", &S::reaction),
                    core::field("radius_m", &S::radius_m),   core::field("circulation_s", &S::circulation_s)};
}
PhysiologyState make_state(const PhysiologyModel& model);

struct PhysiologyScratch {
  FlowScratch flow;
  ContrastScratch contrast;
  std::vector<double> open;
};

/// What lack of blood and contrast in the muscle do to the heart, for the next step.
void burden(const PhysiologyModel& model, const PhysiologyState& state, CirculationInputs& body);

/// Advances by `dt_s`, up to `circulation_step_s`. Deterministic; does not allocate after the first call with the same
/// scratch. Returns the report of the last contrast step.
ContrastReport step(const PhysiologyModel& model, const PhysiologyInputs& inputs, double dt_s, PhysiologyState& state,
                    PhysiologyScratch& scratch);

/// The same in two halves, for callers that need the heart's phase before they know what lies in the vessels: first
/// `step(model.heart, inputs.heart, dt_s, state.heart)`, then this. `beat_begins`: an R wave occurred in the former.
ContrastReport circulate(const PhysiologyModel& model, const PhysiologyInputs& inputs, double dt_s, bool beat_begins,
                         PhysiologyState& state, PhysiologyScratch& scratch);

}  // namespace ostium::vascular
