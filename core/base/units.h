#pragma once
/// Units other than SI, expressed in SI: `2.5 * mm` is 2.5 mm in metres, `x / mm` is a length in millimetres.
#include <numbers>

namespace ostium::units {

inline constexpr double pi = std::numbers::pi;
inline constexpr double degree = pi / 180;             // rad
inline constexpr double mm = 1e-3, cm = 1e-2;          // m
inline constexpr double per_mm = 1e3;                  // 1/m
inline constexpr double inch = 0.0254;                 // m
inline constexpr double gram = 1e-3;                   // kg
inline constexpr double Nmm2 = 1e-6;                   // N m2
inline constexpr double N_per_mm2 = 1e6;               // Pa
inline constexpr double mmHg = 133.322, atm = 101325;  // Pa
inline constexpr double mL = 1e-6;                     // m3
inline constexpr double mm3 = 1e-9;                    // m3
inline constexpr double mL_min = mL / 60;              // m3/s
inline constexpr double mPa_s = 1e-3;                  // Pa s; one centipoise

}  // namespace ostium::units
