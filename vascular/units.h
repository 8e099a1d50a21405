#pragma once
/// Units of the clinic, in SI.

namespace ostium {

inline constexpr double mmHg = 133.322, atm = 101325;  // Pa
inline constexpr double mL = 1e-6;                     // m3
inline constexpr double mL_min = mL / 60;              // m3/s
inline constexpr double mPa_s = 1e-3;                  // Pa s, as much as a centipoise

}  // namespace ostium
