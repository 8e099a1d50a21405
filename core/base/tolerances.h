#pragma once
/// Every tolerance and limit of the engine, on one page. SI.
namespace ostium::core::tolerances {

// What an operator's hand, or a script, may ask for; beyond it a drive is limited and flagged.
inline constexpr double max_drive_speed_m_s = 2.0;     // ten times the fastest scripted hand
inline constexpr double max_drive_turn_rad_s = 200.0;  // 32 turns a second
inline constexpr double max_load_N = 100.0;            // of a tip load

// Inextensibility: strain per tension and element length. At 2 mm, 1 N stretches a rod by 1e-10: a thousandth of the
// least that a gate sees, and 250,000 times stiffer than a steel wire of 0.9 mm is.
inline constexpr double axial_give_per_N_m = 5e-8;
inline constexpr double pulled_apart_stretch = 1e-6;  // only ends that pull a taut rod apart make it give so much

// Most that a joint's cell may turn at rest: with more, elements are too long for the shape.
inline constexpr double max_rest_angle_rad = 2.0;

// Newton iterations of one step.
inline constexpr double stretch_tolerance = 8e-8;  // largest |r' - d3| over the elements; 1e-7 is the gate
inline constexpr double usable_stretch = 1e-2;     // with more, a step is tried again from rest
inline constexpr int max_newton_iterations = 8;
inline constexpr int max_halvings = 4;               // of a step among walls that has no usable solution as a whole
inline constexpr double max_turn_rad = 0.5;          // of an element in one iteration; longer ones are shortened
inline constexpr double overturned_joint_rad = 2.5;  // an angle between elements that is about to pass pi
inline constexpr double longest_return_m = 2e-3;     // per step, of an end that was pulled off its hold

// Binding of nested rods.
inline constexpr double bore_slip_m = 20e-6;   // elastic, of friction in a bore
inline constexpr double leaning_N_m = 0.01;    // force per length that presses an inner rod halfway to its bore's side
inline constexpr double bore_smooth_m = 5e-3;  // along a bore, of what presses an inner rod against it
inline constexpr double leaning_steps = 20;    // it takes to follow
inline constexpr double least_cover = 0.02;    // of a joint's cell: less of a layer counts as this
inline constexpr double torn_part = 0.5;       // of an element: more, and what protrudes is strung anew

// Contact with walls.
inline constexpr double press_N_m = 1e3;        // how soft a wall is thought, to tell who stays pressed against it
inline constexpr double wall_N_m2 = 1e8;        // stiffness of a rigid wall, per length
inline constexpr double wall_slack_m = 0.1e-3;  // that a node may go beyond where it is expected before it is followed
inline constexpr double slid_far_m = 0.15e-3;   // along a wall: on a radius of 1.5 mm, 7 um beside its plane
inline constexpr double wall_pull_N = 1e-5;     // of a tie that is let go in the same step
inline constexpr double wall_loose_m = 0.1e-6;  // behind a wall before a node is tied in the same step
inline constexpr double followed_m = 5e-6;      // behind a wall that was found on the way
inline constexpr double spared_m = 50e-6;       // most that one drives a node off where it was
inline constexpr double passed_wall_m = 20e-6;  // behind a plane, on a way that meets no wall: it ends before that
inline constexpr double same_wall = 0.999;      // cosine between planes that stand for one another
inline constexpr double same_side = 0.5;        // ... of one wall, seen from two places on the same side of it
inline constexpr double same_soft_wall = 0.1;   // ... of a wall that gives way, which push as one
inline constexpr double joined_m = 20e-6;       // farther than the nearest of them: no part of it any more
inline constexpr double most_curved_wall_per_m = 2e4;
inline constexpr double wall_slip_m = 20e-6;     // elastic, of friction
inline constexpr int quick_wall_changes = 3;     // of a linearised step's ties, before their energy is followed down
inline constexpr int max_wall_changes = 60;      // of a linearised step's ties
inline constexpr double least_descent = 1e-4;    // part of the way to a solve's end
inline constexpr double usable_depth_m = 20e-6;  // behind a wall that does not hold; with more, as for usable_stretch

// Contact of rods with each other.
inline constexpr int max_rod_contacts = 2000;  // more are left out
inline constexpr int max_rod_rounds = 24;      // of a step
inline constexpr double rods_near_m = 0.5e-3;  // between their surfaces, to be looked at
inline constexpr double own_apart_radii = 6;   // along a rod, before it can touch itself
inline constexpr double rods_grip = 4;         // stiffness of a contact, to inertia
inline constexpr double rods_slow = 0.3;       // a round that leaves more of the depth is slow: its spring becomes
inline constexpr double rods_harder = 4;       // times as stiff, or, if it went too far,
inline constexpr double rods_softer = 0.5;
inline constexpr double rods_deep_m = 2e-6;    // that is left to the next step
inline constexpr double rods_uneven = 1e-2;    // of the force that both feel, and
inline constexpr double rods_uneven_N = 1e-6;  // as much

// Static equilibrium.
inline constexpr double static_tolerance_rad = 1e-9;  // largest turn of the last iteration; Newton squares it
inline constexpr double static_closure = 1e-7;        // largest distance of an end from its hold, of the rod's length
inline constexpr double static_time_ratio = 100;      // of the last proximal time to the slowest motion's
inline constexpr int max_static_iterations = 400;
inline constexpr double static_turns_back = 0.25;         // of a step: if the next takes back more, that is halved
inline constexpr double concentric_tolerance_rad = 1e-8;  // largest change of an angle between nested instruments
inline constexpr int max_concentric_leans = 3;            // off shapes that are balanced but unstable
inline constexpr int max_concentric_rounds = 100;         // of their angles and the carrier in turn

}  // namespace ostium::core::tolerances
