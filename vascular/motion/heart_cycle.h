#pragma once
/// The cardiac cycle in time: one phase for wall, flow, pressure and ECG, in [0, 1); phase 0 is the R wave.
///
/// Phase is proportional to time at 70 beats a minute. At other rates the length of systole is proportional to the root
/// of the cycle's length (Bazett), so phase advances unevenly; it never jumps when the rate changes.

namespace ostium::vascular {

constexpr double least_rate_1_min = 40, highest_rate_1_min = 180;
constexpr double end_systole = 0.36;  ///< phase; 309 ms after the R wave at 70 beats a minute

/// d phase / dt in 1/s; integrates to one cycle in 60 / rate seconds. Smooth and periodic in phase.
double phase_speed(double phase, double rate_1_min);

/// Time since the R wave in seconds at a constant rate.
double time_at(double phase, double rate_1_min);

/// Contraction of the ventricles: 0 at end-diastole, 1 at end-systole; twice continuously differentiable. Constant
/// around end-systole and in mid-diastole.
double contraction(double phase);

/// Depth of a breath: 0 at end-expiration, 1 at full inspiration, by sin^4 (Lujan 1999); `phase` is that of breathing.
double breath_depth(double phase);

}  // namespace ostium::vascular
