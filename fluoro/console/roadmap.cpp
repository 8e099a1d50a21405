#include "fluoro/console/roadmap.h"

#include <algorithm>
#include <cmath>

#include "fluoro/base/resample.h"

namespace ostium::fluoro {

namespace {

int moment_of(double beat_phase) {
  return std::clamp(static_cast<int>(std::floor((beat_phase - std::floor(beat_phase)) * Roadmap::moments)), 0,
                    Roadmap::moments - 1);
}

Plane smooth_logarithm(const Plane& signal) {
  Plane logarithm = signal.max(1e-3f).log(), scratch;
  gaussian_blur(logarithm, 0.8, Beyond::same, scratch);
  return logarithm;
}

}  // namespace

void Roadmap::record(const View& view, const Plane& signal, double beat_phase) {
  if (!fits(view)) {
    moments_ = {};
    view_ = view;
  }
  Moment& moment = moments_[std::size_t(moment_of(beat_phase))];
  const Plane logarithm = smooth_logarithm(signal);
  if (moment.mask.size() == 0) {
    moment.mask = logarithm;
    moment.contrast = Plane::Zero(signal.rows(), signal.cols());
  } else {
    moment.contrast = moment.contrast.max(moment.mask - logarithm);
  }
}

Plane Roadmap::over(const Plane& signal, double beat_phase) const {
  constexpr float noise = 0.15f, strength = 0.6f;  // of the logarithm: smaller values count as noise
  const int wanted = moment_of(beat_phase);
  for (int off = 0; off <= moments / 2; ++off)
    for (int at : {wanted + off, wanted - off}) {
      const Moment& moment = moments_[std::size_t((at + moments) % moments)];
      if (moment.contrast.size() == signal.size())
        return signal * (-strength * (moment.contrast - noise).max(0.0f)).exp();
    }
  return signal;
}

}  // namespace ostium::fluoro
