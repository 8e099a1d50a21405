#pragma once
/// Two nested beams with play, of small deflection: how the inner one lies within the outer one.
///
/// The stiffness-weighted mean of their centrelines bends as if there were no play, whatever the contact forces.
/// Relative to it each beam is offset by its share of d, the inner beam's offset from the outer one, which minimises
///   integral of EI_r |d'' - (what their free curvatures differ by)|^2 / 2,   1 / EI_r = 1 / EI_inner + 1 / EI_outer,
/// over |d| <= play, clamped at the base and free at the tip: an obstacle problem. In a uniform nest, d crosses from
/// one side of the bore to the other over the last sqrt(12 play / differ), and its slope at the tip is sqrt(3 play
/// differ).
#include <Eigen/Core>
#include <vector>

namespace ostium::data {

struct BeamsWithPlay {
  double cell_m = 0;
  std::vector<double> EI_r_N_m2;              ///< at the start of each cell, the first at the base
  std::vector<Eigen::Vector2d> differ_per_m;  ///< d'' that they would have if free of each other
  Eigen::Vector2d tip_force_N{0, 0};          ///< does work on d at the tip
  Eigen::Vector2d tip_couple_Nm{0, 0};        ///< does work on the slope of d
  double play_m = 0;
};

/// Offset of the inner beam from the outer one.
struct Offsets {
  std::vector<Eigen::Vector2d> bend_per_m;       ///< d'' at the ends of the cells, base first
  Eigen::Vector2d tip_m{0, 0}, tip_slope{0, 0};  ///< d and d' at the outer beam's tip
};

Offsets offsets_of(const BeamsWithPlay& beams);

}  // namespace ostium::data
