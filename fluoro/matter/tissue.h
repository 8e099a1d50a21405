#pragma once
#include "fluoro/matter/scene.h"

namespace ostium::fluoro::tissue {

/// Mixtures (scene.h) that match the attenuation of xraylib's ICRP tissues at 40 and 80 keV, by the linear coefficients
/// checked in tests/fluoro/material_test.cpp: soft tissue 1.00 g/cm3, blood 1.06, muscle 1.04, adipose 0.92, lung at
/// total lung capacity less a breath 0.26.
inline constexpr Tissue air{0, 0};
inline constexpr Tissue soft{1, 0};
inline constexpr Tissue blood{1.046f, 0.012f};
inline constexpr Tissue muscle{1.035f, 0.007f};
inline constexpr Tissue adipose{0.987f, -0.033f};
/// Adipose at 55 keV as less soft tissue: within 5 % from 40 to 80 keV, and, unlike the mixture above, no less than
/// nothing of either attenuator, so that a ray through fat alone does not look like a leak.
inline constexpr Tissue thin_fat{0.89f, 0};
inline constexpr Tissue lung{0.26f, 0.0012f};
inline constexpr Tissue cortical_bone{0, 1};
inline constexpr Tissue spongy_bone{0.93f, 0.12f};  ///< about a tenth to an eighth mineralised
inline constexpr Tissue loose_bone{0.97f, 0.05f};   ///< ribs and sternum: half as dense
inline constexpr Tissue calcified_plaque{0.6f, 0.55f};

}  // namespace ostium::fluoro::tissue
