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
  std::string shows;    ///< vessels it is used for
};

/// Angles are the middles of the ranges in the table of views in Heart (BMJ), and from interventional practice.
const std::vector<StandardView>& standard_views();
/// Empty if there is no view of that name.
std::optional<StandardView> find_view(const std::string& name);
/// "LAO 45 CAU 30"; "AP" for a zero.
std::string angles_text(double lao_deg, double cran_deg);

}  // namespace ostium::fluoro
