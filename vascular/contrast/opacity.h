#pragma once
/// Contrast in the lumen as an X-ray needs it: per vertex of the surface.
#include <span>

#include "vascular/contrast/lumen_map.h"

namespace ostium::vascular {

struct OpacityInputs {
  const FlowModel& flow;
  const ContrastModel& model;
  const ContrastState& state;
  const FlowInputs& lumen;  ///< uses its radius_m and occupied_m
  LumenMoment moment;
  float faintest_kg_m3 = 0;  ///< where blood is nowhere denser, there is none; >= 0
};

/// All (#vertices).
struct Opacity {
  std::span<float> iodine_kg_m3;
  Eigen::Ref<Eigen::Matrix3Xf> p;  ///< centreline point of each vertex, m
  /// Integral of concentration times centreline element up to that point, kg/m2 (explained in fluoro/matter/scene.h).
  Eigen::Ref<Eigen::Matrix3Xf> along;
};

struct OpacityScratch {
  std::vector<float> coronary, aorta;
  Eigen::Matrix3Xf coronary_p, aorta_p, coronary_along, aorta_along;
};

/// Without contrast (faintest_kg_m3) only the concentration is set, to zero.
void opacify(const LumenMap& map, const OpacityInputs& inputs, Opacity out, OpacityScratch& scratch);

}  // namespace ostium::vascular
