#pragma once
/// The standard views of coronary angiography, by name.
#include <optional>
#include <string>
#include <vector>

namespace ostium::fluoro {

struct StandardView {
  std::string name;     ///< as `--view` takes it: "spider"
  double lao_deg = 0;   ///< negative: RAO
  double cran_deg = 0;  ///< negative: caudal
  std::string shows;    ///< what it is taken for
};

/// Angles from the middle of the ranges in Heart's (BMJ) table of views and interventional practice.
const std::vector<StandardView>& standard_views();
/// Empty if there is none of that name.
std::optional<StandardView> find_view(const std::string& name);
/// "LAO 45 CAU 30"; "AP" for a zero.
std::string angles_text(double lao_deg, double cran_deg);

}  // namespace ostium::fluoro
