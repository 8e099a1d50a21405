#pragma once
/// Scattered radiation behind the anti-scatter grid, by scatter kernel superposition (Sun and Star-Lack 2010, Phys Med
/// Biol 55:6695): each primary ray spreads a kernel, which grows with the thickness that it went through.
#include "fluoro/base/plane.h"

namespace ostium::fluoro {

/// Signal scattered per primary signal behind the thickness T of soft tissue, A(T) = per_m T + per_m2 T^2, and how it
/// is spread over the detector: two Gaussians. Fitted to photon transport through slabs of 5 to 30 cm at 80 kV with an
/// opaque focused grid of ratio 12, isocentre to detector 33 cm (app/verify/photon_transport.h); from 65 to 110 kV A
/// changes by less than 14 %.
struct ScatterKernel {
  double per_m = 0.875, per_m2 = 3.8;
  double narrow_m = 0.030, wide_m = 0.160;  ///< standard deviations at the detector
  double narrow_share = 0.32;
};

struct ScatterInput {
  const Plane& primary;  ///< signal of each pixel; outside the picture nothing arrives
  double open;           ///< signal with nothing in between
  double soft_1_m;       ///< effective attenuation of soft tissue: turns attenuation into thickness
  double field_m;        ///< side of the picture at the detector
};

/// Signal to be added to the primary one. Works on cells of some 6 mm: scatter is smooth.
void scatter(const ScatterInput& in, const ScatterKernel& kernel, Plane& out);

}  // namespace ostium::fluoro
