#pragma once
/// How a section's curvature answers the history of its moment: kappa = M / EI + what slipped, yielded or transformed.
///
/// Slip and yield are kinematic hardening, driven by the moment: kappa_p changes while |M - H kappa_p| = M_y
/// (Prager 1956, J Appl Mech 23:493). Transformation has a loading branch above M_1 and an unloading branch below M_2
/// (a flag; Auricchio, Taylor 1997, Comput Methods Appl Mech Eng 146:281).
#include <algorithm>
#include <array>
#include <cmath>

#include "core/material/bending_curve.h"

namespace ostium::data::three_point_bend {

/// Curvature and moment over EI are both in 1/m here, so that no stiffness is needed.
struct Hardening {
  double from_per_m = 0;  ///< M_y / EI; 0: none
  double ratio = 1;       ///< tangent stiffness beyond it against that below
  double slipped(double before_per_m, double moment_per_m) const {
    if (from_per_m <= 0) return 0;
    const double H = ratio / (1 - ratio);
    return std::clamp(before_per_m, (moment_per_m - from_per_m) / H, (moment_per_m + from_per_m) / H);
  }
};

struct Flag {
  double up_per_m = 0;    ///< M_1 / EI, where transformation begins; 0: none
  double down_share = 1;  ///< M_2 / M_1
  double ratio = 1;       ///< tangent stiffness on the plateau against that below
  double transformed(double before_per_m, double moment_per_m) const {
    if (up_per_m <= 0) return 0;
    const double H = ratio / (1 - ratio), size = std::fabs(moment_per_m), sign = moment_per_m < 0 ? -1 : 1;
    const double least = std::max((size - up_per_m) / H, 0.0), most = std::max((size - down_share * up_per_m) / H, 0.0);
    return sign * std::clamp(sign * before_per_m, least, most);
  }
};

/// Play elements in series (Prandtl, Ishlinskii): each gives by `weight` times what the moment has moved beyond its
/// threshold, on either side.
struct Plays {
  static constexpr int most = 8;
  int count = 0;
  std::array<double, most> from_per_m{}, weight{};
};

struct SectionLaw {
  Hardening slip, yield;
  Flag flag;
  core::BendingCurve bending;
  Plays plays;
  bool linear() const {
    return slip.from_per_m <= 0 && yield.from_per_m <= 0 && flag.up_per_m <= 0 && bending.linear() && plays.count == 0;
  }
};

/// What a section remembers.
struct SectionState {
  double slipped_per_m = 0, yielded_per_m = 0, transformed_per_m = 0;
  std::array<double, Plays::most> played_per_m{};

  SectionState after(const SectionLaw& law, double moment_per_m) const {
    SectionState out{law.slip.slipped(slipped_per_m, moment_per_m), law.yield.slipped(yielded_per_m, moment_per_m),
                     law.flag.transformed(transformed_per_m, moment_per_m)};
    for (int j = 0; j < law.plays.count; ++j)
      out.played_per_m[j] =
          std::clamp(played_per_m[j], moment_per_m - law.plays.from_per_m[j], moment_per_m + law.plays.from_per_m[j]);
    return out;
  }
  /// Curvature beyond moment / EI.
  double extra_per_m(const SectionLaw& law, double moment_per_m) const {
    double out = slipped_per_m + yielded_per_m + transformed_per_m;
    for (int j = 0; j < law.plays.count; ++j) out += law.plays.weight[j] * played_per_m[j];
    if (!law.bending.linear())
      out += std::copysign(law.bending.curvature_at(std::fabs(moment_per_m)), moment_per_m) - moment_per_m;
    return out;
  }
};

}  // namespace ostium::data::three_point_bend
