#pragma once
/// How a section's curvature answers the history of its moment: kappa = M / EI + what slipped, yielded or transformed.
///
/// Slip and yield are kinematic hardening, driven by the moment: kappa_p changes while |M - H kappa_p| = M_y
/// (Prager 1956, J Appl Mech 23:493). Transformation has a loading branch above M_1 and an unloading branch below M_2
/// (a flag; Auricchio, Taylor 1997, Comput Methods Appl Mech Eng 146:281).
#include <algorithm>
#include <cmath>

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

struct SectionLaw {
  Hardening slip, yield;
  Flag flag;
  bool linear() const { return slip.from_per_m <= 0 && yield.from_per_m <= 0 && flag.up_per_m <= 0; }
};

/// What a section remembers.
struct SectionState {
  double slipped_per_m = 0, yielded_per_m = 0, transformed_per_m = 0;

  SectionState after(const SectionLaw& law, double moment_per_m) const {
    return {law.slip.slipped(slipped_per_m, moment_per_m), law.yield.slipped(yielded_per_m, moment_per_m),
            law.flag.transformed(transformed_per_m, moment_per_m)};
  }
  double extra_per_m() const { return slipped_per_m + yielded_per_m + transformed_per_m; }
};

}  // namespace ostium::data::three_point_bend
