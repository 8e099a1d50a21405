#pragma once
/// Result of a moment-curvature law.
#include "core/math/lanes.h"

namespace ostium::core {

template <class T>
struct MomentResponse {
  V3<T> moment;   ///< N m, in the material frame
  S3<T> tangent;  ///< d moment / d strain, N m2, symmetric and positive definite
};

}  // namespace ostium::core
