#pragma once
/// Veiling glare: light that the scintillator and what carries it scatter far away, and X-rays scattered in the
/// detector's own housing. A veil over the picture: the contrast of everything small falls by its share, which is the
/// low-frequency drop of the modulation transfer function.
#include "fluoro/base/plane.h"

namespace ostium::fluoro {

/// The share is the drop measured on a flat panel of caesium iodide, 8 % at 60 kV to 10.5 % at 120 kV (Lazos and
/// Williamson 2012, Med Phys 39:5639). How far it spreads is an estimate: centimetres, so that the drop is complete
/// well below 0.1 line pairs a millimetre.
struct GlareKernel {
  double share = 0.09;     ///< of the signal
  double spread_m = 0.02;  ///< standard deviation at the detector
};

/// signal = (1 - share) signal + share (signal spread out); beyond the picture nothing arrives.
void add_glare(const GlareKernel& kernel, double field_m, Plane& signal, Plane& scratch);

}  // namespace ostium::fluoro
