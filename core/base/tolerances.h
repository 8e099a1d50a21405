#pragma once
/// Every tolerance and limit of the engine in one place. SI units.
namespace ostium::core::tolerances {

// Limits on what an operator or a script may command; a drive beyond them is limited and flagged.
inline constexpr double max_drive_speed_m_s = 2.0;     // ten times the fastest scripted operator
inline constexpr double max_drive_turn_rad_s = 200.0;  // 32 turns per second
inline constexpr double max_load_N = 100.0;            // tip load

// Axial compliance: strain per tension and element length. With 2 mm elements, 1 N stretches a rod by 1e-10: a
// thousandth of what the gates resolve, and 250,000 times stiffer than a steel wire of 0.9 mm.
inline constexpr double axial_give_per_N_m = 5e-8;
inline constexpr double pulled_apart_stretch = 1e-6;  // exceeded only where held ends pull a taut rod apart

// Largest angle of a joint's cell at rest; beyond it, elements are too long for the shape.
inline constexpr double max_rest_angle_rad = 2.0;

// Newton iterations of one step.
inline constexpr double stretch_tolerance = 8e-8;  // largest |r' - d3| over the elements; the gate is 1e-7
inline constexpr double usable_stretch = 1e-2;     // above this, the step is retried from rest
inline constexpr int max_newton_iterations = 8;
inline constexpr int patient_iterations = 4;         // then a step that goes astray is halved at once
inline constexpr double astray_defect = 2e-3;        // largest |r' - d3|, and grown: elements turned by 0.06 rad
inline constexpr int max_halvings = 4;               // of a step with walls that has no usable solution as a whole
inline constexpr double max_turn_rad = 0.5;          // of an element per iteration; larger ones are scaled down
inline constexpr double overturned_joint_rad = 2.5;  // angle between elements that is flagged as close to pi
inline constexpr double longest_return_m = 2e-3;     // per step, for an end that was pulled off its hold

// Nesting.
inline constexpr double bore_slip_m = 20e-6;   // elastic slip of friction in a bore
inline constexpr double leaning_N_m = 0.01;    // contact force that moves an inner rod halfway to the side
inline constexpr double bore_smooth_m = 5e-3;  // length over which an inner rod's contact force on its bore is smoothed
inline constexpr double leaning_steps = 20;    // time constant of that sideways move, in steps
inline constexpr double least_cover = 0.02;    // share of a joint's cell: a layer that covers less counts as this much
inline constexpr double torn_part = 0.5;       // gap, in elements, above which the protruding part is moved

// Contact with walls.
inline constexpr double press_N_m = 1e3;        // wall stiffness assumed when predicting which nodes stay in contact
inline constexpr double wall_N_m2 = 1e8;        // stiffness of a rigid wall per length of instrument
inline constexpr double wall_slack_m = 0.1e-3;  // beyond the predicted position: then continuous collision
inline constexpr double slid_far_m = 0.15e-3;   // ... when sliding along it: at 1.5 mm radius, 7 um off the plane
inline constexpr double wall_pull_N = 1e-5;     // tension at which a tie is released within the step
inline constexpr double wall_loose_m = 0.1e-6;  // depth at which a node is tied within the step
inline constexpr double followed_m = 5e-6;      // depth at which a wall found by continuous collision counts
inline constexpr double spared_m = 50e-6;       // most that such a wall pushes a node away from its start
inline constexpr double passed_wall_m = 20e-6;  // behind a plane on a path that meets no wall: the wall ended
inline constexpr double same_point_m = 1e-8;    // between nearest points of triangles that meet there
inline constexpr double same_wall = 0.999;      // cosine between planes that replace one another
inline constexpr double about_same_wall = 0.9;  // ... between a plane and the wall that it stands for
inline constexpr double same_side = 0.5;        // ... between two views of one wall from the same side
inline constexpr double same_soft_wall = 0.1;   // ... between planes of a soft wall that push as one
inline constexpr double joined_m = 20e-6;       // a plane farther than the nearest by this is not joined with it
inline constexpr double most_curved_wall_per_m = 2e4;
inline constexpr double wall_slip_m = 20e-6;     // elastic slip of friction at a wall
inline constexpr int quick_wall_changes = 3;     // changes of ties per linearisation before the line search starts
inline constexpr int max_wall_changes = 60;      // changes of ties per linearisation
inline constexpr int window_margin = 10;         // nodes beside those whose ties changed that are settled with them
inline constexpr int longest_window = 90;        // nodes
inline constexpr double least_descent = 1e-4;    // resolution of the line search, as a share of its direction
inline constexpr int max_looks_anew = 2;         // per step, at walls between which a node is pressed deep
inline constexpr double usable_depth_m = 20e-6;  // behind a wall that does not hold the node; see usable_stretch

// Contact of rods with each other.
inline constexpr int max_rod_contacts = 2000;  // further ones are ignored
inline constexpr int max_rod_rounds = 24;      // per step
inline constexpr double rods_near_m = 0.5e-3;  // gap between surfaces below which a pair is considered
inline constexpr double own_apart_radii = 6;   // distance along a rod, per sum of radii, before it can touch itself
inline constexpr double rods_grip = 4;         // contact stiffness relative to inertia
inline constexpr double rods_slow = 0.3;       // a round that leaves more of the depth is slow: its spring becomes
inline constexpr double rods_harder = 4;       // this many times as stiff, or, if it overshot,
inline constexpr double rods_softer = 0.5;
inline constexpr double rods_deep_m = 2e-6;    // depth left for the next step
inline constexpr double rods_uneven = 1e-2;    // allowed difference between the forces on the two rods: relative plus
inline constexpr double rods_uneven_N = 1e-6;  // absolute

// Static equilibrium.
inline constexpr double static_tolerance_rad = 1e-9;  // largest turn in the last iteration; Newton's method squares it
inline constexpr double static_closure = 1e-7;        // distance of an end from its hold, relative to rod length
inline constexpr double static_time_ratio = 100;      // last proximal time relative to the slowest motion
inline constexpr int max_static_iterations = 400;
inline constexpr double static_turns_back = 0.25;         // of a step: if the next one takes back more, that is halved
inline constexpr double concentric_tolerance_rad = 1e-8;  // largest change of an angle between nested instruments
inline constexpr int max_concentric_leans = 3;            // perturbations to leave balanced but unstable shapes
inline constexpr int max_concentric_rounds = 100;         // alternating between angles and carrier

}  // namespace ostium::core::tolerances
