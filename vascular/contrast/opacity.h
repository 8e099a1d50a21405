#pragma once
/// What an X-ray needs to know of the contrast in the lumen, at each vertex of its surface.
#include <span>

#include "vascular/contrast/lumen_map.h"

namespace ostium::vascular {

struct OpacityInputs {
  const FlowModel& flow;
  const ContrastModel& model;
  const ContrastState& state;
  const FlowInputs& lumen;  ///< radius_m and occupied_m of it
  double phase = 0, breath = 0;
};

/// All (#vertices).
struct Opacity {
  std::span<float> iodine_kg_m3;
  Eigen::Ref<Eigen::Matrix3Xf> p;  ///< the point of the centreline that a vertex belongs to, m
  /// The integral of concentration times the centreline's element up to that point, kg/m2 (fluoro/scene.h says what
  /// for).
  Eigen::Ref<Eigen::Matrix3Xf> along;
};

struct OpacityScratch {
  std::vector<float> coronary, aorta;
  Eigen::Matrix3Xf coronary_p, aorta_p, coronary_along, aorta_along;
};

void opacify(const LumenMap& map, const OpacityInputs& inputs, Opacity out, OpacityScratch& scratch);

}  // namespace ostium::vascular
