#pragma once
/// Where a stiff wire presses on the walls of a tube with bends, by its stiffness alone.
///
/// Law: small deviations w from the tube's axis, within the clearance, |w| <= c, with the least energy
///   integral of EI / 2 (w'' + kappa)^2 ds,
/// kappa being the axis' curvature. Both ends are free. The multipliers of the walls are the forces. EI and kappa are
/// constant by pieces, so a wire touches at points: between two of them the moment M is straight, EI (w'' + kappa) = M
/// makes w a cubic in each piece, and the slopes on both sides of a touch agree, which gives the moments (equation of
/// three moments; Clapeyron 1857, C R Acad Sci 45:1076). A force is what the shear M' changes by.
///
/// Touches are sought among places `spacing` apart, and the tip, by a dual active-set method: the place that is beyond
/// the wall most is added; forces move towards those of the new set, and a touch that would pull is taken out on the
/// way (Goldfarb, Idnani 1983, Math Program 27:1). What is left where nothing is bent is a line within the walls, if
/// there is one (Chebyshev): then the wire presses nowhere.
///
/// Range: c well below the radii, slopes small. Forces are proportional to EI: only its ratios matter for the shape.
#include "data/identification/curves/push_pull/path.h"

namespace ostium::data::push_pull {

/// A touch of a solution, to begin another from.
struct Touch {
  long place = 0;  ///< in spacings from where the wire begins to be guided, or `at_tip`
  int side = 1;    ///< 1: inside of the bends, -1: outside
};
inline constexpr long at_tip = -1;

class ChannelBeam {
 public:
  /// Walls guide the wire from `from_m` on, which may be before the entrance (negative).
  ChannelBeam(std::vector<Bend> bends, double from_m, double spacing_m);

  /// Of a wire with its tip at `tip_m`, from the entrance to the tip. `touches`: of a similar wire or empty; then of
  /// this one.
  std::vector<WallForce> forces(double tip_m, double clearance_m, const std::vector<StiffPiece>& stiffness,
                                std::vector<Touch>& touches) const;

 private:
  std::vector<Bend> bends_;
  double from_m_, spacing_m_;
};

}  // namespace ostium::data::push_pull
