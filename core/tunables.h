#pragma once
/// Every tolerance and limit of the engine, on one page. SI.
namespace ostium::tunables {

// --- what an operator's hand, or a script, may ask for; beyond it a drive is limited and flagged ----------------------
inline constexpr double max_drive_speed_m_s = 2.0;       // ten times the fastest scripted hand
inline constexpr double max_drive_turn_rad_s = 200.0;    // 32 turns a second
inline constexpr double max_load_N = 100.0;              // per component of a tip load

// --- Newton iterations of one step --------------------------------------------------------------------------------
inline constexpr double stretch_tolerance = 2e-8;        // largest |r' - d3| over the elements; 1e-7 is the gate
inline constexpr int max_newton_iterations = 8;
inline constexpr double max_turn_rad = 0.5;              // of an element in one iteration; longer ones are shortened

// --- static equilibrium ---------------------------------------------------------------------------------------------
inline constexpr double static_tolerance_rad = 1e-9;     // largest turn of the last iteration; Newton squares it
inline constexpr double static_time_ratio = 100;         // of the last proximal time to the slowest motion's
inline constexpr int max_static_iterations = 400;

}  // namespace ostium::tunables
