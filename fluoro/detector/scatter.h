#pragma once
/// Scattered radiation behind the anti-scatter grid, by scatter kernel superposition (Sun and Star-Lack 2010, Phys Med
/// Biol 55:6695): each primary ray spreads a kernel that grows with the thickness it has crossed.
#include "fluoro/base/plane.h"

namespace ostium::fluoro {

/// Ratio of scatter to primary signal behind a thickness T of soft tissue, A(T) = per_m T + per_m2 T^2, spread over the
/// detector as two Gaussians. Fitted to photon transport through slabs of 5 to 30 cm at 80 kV with an opaque focused
/// grid of ratio 12, isocentre to detector 33 cm (app/gates/xray/photon_transport.h); from 65 to 110 kV A changes by
/// less than 14 %.
struct ScatterKernel {
  double per_m = 0.875, per_m2 = 3.8;
  double narrow_m = 0.030, wide_m = 0.160;  ///< standard deviations at the detector
  double narrow_share = 0.32;
};

struct ScatterInput {
  const Plane& primary;  ///< primary signal of each pixel; zero outside the picture
  double open;           ///< signal with nothing in between
  double soft_1_m;       ///< effective attenuation of soft tissue: converts attenuation to thickness
  double field_m;        ///< side of the picture at the detector
};

/// The scatter to be added to the primary signal. Computed on cells of about 6 mm, as scatter is smooth.
void scatter(const ScatterInput& in, const ScatterKernel& kernel, Plane& out);

}  // namespace ostium::fluoro
