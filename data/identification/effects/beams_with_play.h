#pragma once
/// Two nested beams with play, of small deflection: where the inner one lies in the outer one.
///
/// Their line weighted by stiffness bends as if there were no play, whatever they give to each other. Against it they
/// lie off by their shares of d, the inner one's offset from the outer one, which makes
///   integral of EI_r |d'' - (what their free curvatures differ by)|^2 / 2,   1 / EI_r = 1 / EI_inner + 1 / EI_outer,
/// least among those with |d| <= play, clamped at the base and free at the tip: an obstacle problem. Where all is even,
/// d crosses from one side of the bore to the other over the last sqrt(12 play / differ), and slopes by
/// sqrt(3 play differ) at the tip.
#include <Eigen/Core>
#include <vector>

namespace ostium::data {

struct BeamsWithPlay {
  double cell_m = 0;
  std::vector<double> EI_r_N_m2;              ///< at the cells' beginnings, the first at the base
  std::vector<Eigen::Vector2d> differ_per_m;  ///< d'' that they would have if they were free of each other
  Eigen::Vector2d tip_force_N{0, 0};          ///< working on d at the tip
  Eigen::Vector2d tip_couple_Nm{0, 0};        ///< ... on its slope
  double play_m = 0;
};

/// Of the inner one against the outer one.
struct Offsets {
  std::vector<Eigen::Vector2d> bend_per_m;       ///< d'' at the cells' ends, the base first
  Eigen::Vector2d tip_m{0, 0}, tip_slope{0, 0};  ///< d and d' at the outer one's tip
};

Offsets offsets_of(const BeamsWithPlay& beams);

}  // namespace ostium::data
