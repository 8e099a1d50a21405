#pragma once
/// A law that is learned from data, as a curve.
#include <Eigen/Core>
#include <string>
#include <vector>

namespace ostium::data {

/// Ids of laws begin with this.
inline constexpr const char* law_prefix = "law:";

inline bool is_law(const std::string& id) { return id.starts_with(law_prefix); }

struct LawCurve {
  std::string id;                       ///< "law:stiffness"
  std::string x, x_unit, y, y_unit;     ///< "distance from the tip", "mm"; units as in files
  std::vector<Eigen::Vector2d> points;  ///< x rises
  double declared = 1;                  ///< y of what is declared, the same everywhere
  /// Standard deviation of ln y at each point that the law's form is too coarse to show: what its prior has between
  /// knots or in shorter waves. Empty: none.
  std::vector<double> too_fine = {};
};

}  // namespace ostium::data
