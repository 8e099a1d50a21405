#include "fluoro/projection/views.h"

#include <cmath>

namespace ostium::fluoro {

const std::vector<StandardView>& standard_views() {
  static const std::vector<StandardView> all = {
      {"ap", 0, 0, "orientation, left main"},
      {"lao", 40, 0, "right coronary, its middle"},
      {"rao", -30, 0, "right coronary, its middle"},
      {"ap-cranial", 0, 30, "right coronary's crux and its branches"},
      {"rao-cranial", -10, 40, "LAD and its diagonals"},
      {"lao-cranial", 45, 25, "LAD, septals and diagonals apart"},
      {"spider", 45, -30, "left main, its bifurcation, circumflex origin"},
      {"rao-caudal", -20, -25, "circumflex and its marginals"},
      {"ap-caudal", 0, -30, "left main, circumflex"},
      {"lm-cranial", 0, 40, "left main, LAD origin"},
      {"lao-cranial-right", 45, 30, "right coronary's crux"},
      {"left-lateral", 90, 0, "LAD, aortic arch"},
  };
  return all;
}

std::optional<StandardView> find_view(const std::string& name) {
  for (const StandardView& view : standard_views())
    if (view.name == name) return view;
  return {};
}

std::string angles_text(double lao_deg, double cran_deg) {
  const auto one = [](double angle, const char* plus, const char* minus) {
    const long rounded = std::lround(angle);
    return rounded == 0 ? std::string()
                        : (rounded > 0 ? plus : minus) + std::string(" ") + std::to_string(std::labs(rounded));
  };
  const std::string first = one(lao_deg, "LAO", "RAO"), second = one(cran_deg, "CRA", "CAU");
  return (first.empty() ? "AP" : first) + (second.empty() ? "" : " " + second);
}

}  // namespace ostium::fluoro
