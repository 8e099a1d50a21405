#pragma once
/// The phases of a step that a PhaseClock tells apart (Scratch::clock).
namespace ostium::core {

enum StepPhase {
  predicting,     ///< drives, nests, expected shapes, and whatever is not named below
  finding_walls,  ///< those that each node can reach
  linearising,    ///< joints, elements, inertia
  first_solving,  ///< the first solve of an iteration
  later_solving,  ///< those after ties were changed
  changing_ties,  ///< which walls hold which node
  finishing,      ///< committing the solution, forces, touches
  step_phases
};

inline constexpr const char* step_phase_names[step_phases] = {"predict",      "find walls",  "linearise", "first solve",
                                                              "later solves", "change ties", "finish"};

}  // namespace ostium::core
