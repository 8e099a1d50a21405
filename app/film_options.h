#pragma once
/// What commands that make pictures of a session have in common.
#include <limits>
#include <string>
#include <vector>

namespace ostium {

struct PictureOptions {
  static constexpr double as_view = std::numeric_limits<double>::quiet_NaN();
  std::string view;                              ///< empty: as the run has it
  double lao_deg = as_view, cran_deg = as_view;  ///< instead of the view's
  double field_mm = as_view;
  std::vector<double> table_mm;  ///< empty: as the run has it
  int pixels = 512;
  bool cine = false, plain = false;  ///< plain: without overlay
  bool monitor = false;              ///< ECG, pressure and gauge under the picture
  double frames_per_s = 15;
  std::string fill = "none";
};

}  // namespace ostium
