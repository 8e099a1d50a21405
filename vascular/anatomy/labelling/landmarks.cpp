#include "vascular/anatomy/labelling/landmarks.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/units.h"

namespace ostium::vascular {

using units::mm;

void set_access(const std::optional<Eigen::Vector3d>& entry, Anatomy& anatomy, std::vector<std::string>& notes) {
  Landmarks& marks = anatomy.landmarks;
  const std::vector<Tube>& tubes = anatomy.tubes;
  int tube = 0;
  double s = anatomy.aorta ? tubes[0].length_m() - std::min(20 * mm, 0.1 * tubes[0].length_m()) : 2 * mm;
  bool inwards = !anatomy.aorta;
  if (entry) {
    const Eigen::Vector3d p = *entry;
    double nearest = 1e9;
    for (int t = 0; t < static_cast<int>(tubes.size()); ++t) {
      const double at = nearest_s(tubes[t], p), d = (tubes[t].at(at).p - p).norm() - tubes[t].at(at).radius_m;
      if (d < nearest) nearest = d, tube = t, s = at;
    }
    inwards = tubes[tube].parent < 0 && !anatomy.aorta && s < tubes[tube].length_m() / 2;
    if (nearest > 10 * mm)
      notes.push_back(fmt::format("the entry asked for lies {:.0f} mm outside the lumen", nearest / mm));
  }
  // Not at the very tip.
  s = std::clamp(s, 1 * mm, std::max(1 * mm, tubes[tube].length_m() - 2 * tubes[tube].nodes.back().radius_m));
  marks.p_access = tubes[tube].at(s).p;
  marks.access_direction = (inwards ? 1 : -1) * tubes[tube].tangent(s);
}

void set_landmarks(const LandmarkInputs& in, Anatomy& anatomy, std::vector<std::string>& notes) {
  Landmarks& marks = anatomy.landmarks;
  const Landmarks& mean = in.mean;
  const std::vector<Tube>& tubes = anatomy.tubes;
  const auto ostium = [&](const char* name, const Eigen::Vector3d& ours) {
    const auto found = in.ostia.find(name);
    return found != in.ostia.end() ? found->second : in.fit * ours;
  };
  marks.p_left_ostium = ostium("LM", mean.p_left_ostium);
  marks.p_right_ostium = ostium("RCA", mean.p_right_ostium);
  marks.p_lv_base = in.fit * mean.p_lv_base;
  marks.p_lv_apex = in.fit * mean.p_lv_apex;
  marks.right_groove = in.fit.R * mean.right_groove;
  marks.p_annulus = in.fit * mean.p_annulus;
  marks.root_axis = in.fit.R * mean.root_axis;
  if (anatomy.aorta) {
    marks.root_axis = tubes[0].tangent(8 * mm);
    // The tube begins where the widest sphere fits; the annulus is proximal to that.
    marks.p_annulus = tubes[0].nodes.front().p - 0.8 * tubes[0].nodes.front().radius_m * marks.root_axis;
  }
  set_access(in.entry, anatomy, notes);
}

}  // namespace ostium::vascular
